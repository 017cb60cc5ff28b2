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
    std::optional<PixelBox> common;   // what both images have, where one lacks pixels; all else is left out
};

// Where an image lacks pixels (a crop window), both are compared, and kept, in the window that they share.
// Throws Error(input_refused) when they share none, and as selected_pixels and measure_difference do.
[[nodiscard]] ImageComparison compare_images(Image ref, Image test, Selection selection);

// |test - reference| in R G B and the FLIP map in flip.Y. For the screen: the FLIP map in R G B, or the first
// where there is none.
[[nodiscard]] Image difference_image(const ImageComparison& comparison, bool is_for_screen);

}  // namespace voxilux
