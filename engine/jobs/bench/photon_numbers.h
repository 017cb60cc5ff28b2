#pragma once

// What `bench photons` measures of pictures and times, as numbers.

#include <array>
#include <optional>
#include <span>

#include "estimators/metrics.h"
#include "formats/image.h"

namespace voxilux {

inline constexpr double kEmitterLuminance =
    5.0;  // above it a pixel shows an emitter, whose border is all antialiasing
inline constexpr int kEmitterMargin = 3;   // pixels around emitters that are left out, too
inline constexpr double kBlurSigma = 2.0;  // pixels; hides noise, and keeps what light from glass draws

// White where a picture is judged: black within kEmitterMargin steps along rows and columns of a pixel whose
// luminance in `reference` is above kEmitterLuminance.
[[nodiscard]] Image emitter_mask(const Image& reference);

// RMS of the difference in luminance over the box, after a Gaussian filter of kBlurSigma that is cut at four
// deviations; at its borders the picture is mirrored. Both pictures have one size and colours.
[[nodiscard]] double blurred_rmse(const Image& reference, const Image& test, const PixelBox& box);

struct PhotonErrors {
    double relmse = 0.0;           // over all pixels that show no emitter
    std::array<double, 3> bias{};  // mean over that of the reference, less 1, of each channel
    std::optional<double> floor;   // blurred_rmse
};

// Throws Error(input_refused) when the pictures differ in size or the box leaves them.
[[nodiscard]] PhotonErrors photon_errors(const Image& reference, const Image& test,
                                         const std::optional<PixelBox>& box);

}  // namespace voxilux
