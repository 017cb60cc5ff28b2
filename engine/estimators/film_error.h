#pragma once

#include "estimators/error_estimate.h"
#include "film/film_sums.h"

namespace voxilux {

// The error of the beauty: from the squares where there are some and samples are independent, else from the
// halves; with its bias where the film knows it.
[[nodiscard]] ErrorEstimate error_of(const FilmSums& film);

}  // namespace voxilux
