#pragma once

#include <span>

#include "estimators/error_estimate.h"

namespace voxilux {

// The error of a denoised picture by estimates of its pixels, [height][width]: of relMSE without bias
// (squared_error() in shared/denoise.h), and of what of it is variance. Mean error is the larger one of the
// two means, because relMSE has more noise and variance cannot exceed it. The interval comes from blocks of
// pixels.
[[nodiscard]] ErrorEstimate denoised_error(int width, int height, std::span<const float> relmse,
                                           std::span<const float> variance);

}  // namespace voxilux
