#pragma once

#include <vector>

#include "film/error_estimate.h"
#include "film/film.h"
#include "film/image.h"
#include "plan/render_plan.h"
#include "scene/scene.h"
#include "vk/executor.h"

namespace voxilux {

// Samples that each row of the picture has received; rows differ only after an interruption.
using RowSamples = std::vector<std::uint32_t>;

struct FilmReadback {
    Image image;          // every channel that the plan delivers
    ErrorEstimate error;  // of the beauty
};

// Reads the film from the device and turns its sums into pictures.
[[nodiscard]] FilmReadback read_film(const RenderPlan& plan, const RowSamples& samples, Executor& executor);

// The error estimate alone, from the two halves of the beauty.
[[nodiscard]] ErrorEstimate read_error(const RenderPlan& plan, const RowSamples& samples, Executor& executor);

}  // namespace voxilux
