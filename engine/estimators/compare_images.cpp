#include "estimators/compare_images.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace voxilux {

ImageComparison compare_images(Image ref, Image test, const Selection& selection) {
    ImageComparison result{.ref = std::move(ref), .test = std::move(test)};
    const std::vector<std::size_t> pixels = selected_pixels(result.ref.width, result.ref.height, selection);
    result.metrics = measure_difference(result.ref, result.test, pixels);
    result.flip = flip(result.ref, result.test);
    if (result.flip) result.flip_mean = mean_flip(*result.flip, pixels);
    return result;
}

Image difference_image(const ImageComparison& comparison, bool is_for_screen) {
    const auto ref = *colour_planes(comparison.ref);
    const auto test = *colour_planes(comparison.test);
    const std::array<std::string, 3> names = {"R", "G", "B"};
    Image image = make_image(comparison.ref.width, comparison.ref.height, names);
    for (std::size_t channel = 0; channel < names.size(); ++channel) {
        std::vector<float>& plane = image.channels[names[channel]].pixels;
        for (std::size_t i = 0; i < plane.size(); ++i)
            plane[i] = is_for_screen && comparison.flip ? comparison.flip->error[i]
                                                        : std::abs(test[channel][i] - ref[channel][i]);
    }
    if (comparison.flip && !is_for_screen) image.channels["flip.Y"].pixels = comparison.flip->error;
    return image;
}

}  // namespace voxilux
