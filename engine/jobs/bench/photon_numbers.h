#pragma once

// The measures that `bench photons` takes of images and times.

#include <array>
#include <optional>
#include <span>

#include "estimators/metrics.h"
#include "formats/image.h"

namespace voxilux {

inline constexpr double kEmitterLuminance =
    5.0;  // above it a pixel shows an emitter, where antialiasing dominates the error
inline constexpr int kEmitterMargin = 3;   // pixels around emitters that are left out as well
inline constexpr double kBlurSigma = 2.0;  // pixels; hides noise, and keeps caustics

// White where an image is compared: black within kEmitterMargin steps along rows and columns of a pixel whose
// luminance in `reference` is above kEmitterLuminance.
[[nodiscard]] Image emitter_mask(const Image& reference);

// RMS difference of luminance over the box, after a Gaussian filter of kBlurSigma that is cut off at four
// standard deviations and mirrors the image at its borders. Both images have the same size and colour
// channels.
[[nodiscard]] double blurred_rmse(const Image& reference, const Image& test, const PixelBox& box);

struct PhotonErrors {
    double relmse = 0.0;           // over all pixels that show no emitter
    std::array<double, 3> bias{};  // relative error of the mean, by channel
    std::optional<double> floor;   // blurred_rmse
};

// Throws Error(input_refused) when the images differ in size or the box exceeds them.
[[nodiscard]] PhotonErrors photon_errors(const Image& reference, const Image& test,
                                         const std::optional<PixelBox>& box);

}  // namespace voxilux
