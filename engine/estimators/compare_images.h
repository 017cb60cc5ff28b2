#pragma once

#include <optional>

#include "estimators/flip.h"
#include "estimators/metrics.h"
#include "formats/image.h"

namespace voxilux {

// Two images and all metrics between them.
struct ImageComparison {
    Image ref, test;
    Metrics metrics;
    std::optional<FlipResult> flip;   // of the whole images
    std::optional<double> flip_mean;  // over the selected pixels
};

// Throws Error(input_refused) as selected_pixels and measure_difference do.
[[nodiscard]] ImageComparison compare_images(Image ref, Image test, const Selection& selection);

// |test - reference| in R G B and the FLIP map in flip.Y. For the screen: the FLIP map in R G B, or the first
// where there is none.
[[nodiscard]] Image difference_image(const ImageComparison& comparison, bool is_for_screen);

}  // namespace voxilux
