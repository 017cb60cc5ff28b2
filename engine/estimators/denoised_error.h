#pragma once

#include <span>

#include "estimators/error_estimate.h"

namespace voxilux {

// The error of a denoised image from estimates for its pixels, [height][width]: unbiased ones of relMSE
// (squared_error() in shared/denoise.h), and of its part that is variance. The estimate is the larger of the
// two means, because relMSE is noisier, and variance cannot exceed it. The interval comes from blocks of
// pixels.
[[nodiscard]] ErrorEstimate denoised_error(int width, int height, std::span<const float> relmse,
                                           std::span<const float> variance);

}  // namespace voxilux
