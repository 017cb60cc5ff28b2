#pragma once

#include <optional>
#include <vector>

#include "formats/image.h"

namespace voxilux {

// Pixels per degree of visual angle: a 4K screen 0.7 m wide seen from 0.7 m, the default of the FLIP paper.
inline constexpr double kFlipPixelsPerDegree = 0.7 * 3840.0 / 0.7 * (3.14159265358979323846 / 180.0);

// What HDR-FLIP exposes with, in stops; both ends included.
struct FlipExposures {
    double start = 0.0;
    double stop = 0.0;
    int count = 0;
};

struct FlipResult {
    std::vector<float> error;  // [height][width], in [0,1]
    int exposures = 0;         // 0 for LDR-FLIP
};

// LDR-FLIP of two images of one size (asserted) with linear colours in [0,1], clamped to it: Andersson,
// Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild, "FLIP: A Difference Evaluator for Alternating
// Images" (2020). Empty when an image has no colour or a non-finite value.
[[nodiscard]] std::optional<FlipResult> ldr_flip(const Image& reference, const Image& test);

// HDR-FLIP: the maximum of LDR-FLIP over exposures chosen from the reference: Andersson, Nilsson, Shirley,
// Akenine-Moller, "Visualizing Errors in Rendered High Dynamic Range Images" (2021). Negative values count as
// 0. Empty as for ldr_flip, and when the reference is black, for then no exposure is defined.
[[nodiscard]] std::optional<FlipResult> hdr_flip(const Image& reference, const Image& test);

// The exposures for a reference; empty when it is black or has no colour.
[[nodiscard]] std::optional<FlipExposures> flip_exposures(const Image& reference);

// LDR-FLIP when both images are display_referred, HDR-FLIP otherwise.
[[nodiscard]] std::optional<FlipResult> flip(const Image& reference, const Image& test);

// Mean of the error over these pixels.
[[nodiscard]] double mean_flip(const FlipResult& result, const std::vector<std::size_t>& pixels);

}  // namespace voxilux
