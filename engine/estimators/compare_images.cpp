#include "estimators/compare_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "base/error.h"

namespace voxilux {

namespace {

PixelBox intersection(const PixelBox& a, const PixelBox& b) {
    return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

// Pixels outside are black on both sides, so that FLIP, which looks around a pixel, finds no difference
// there.
void keep_window(Image& image, const PixelBox& box) {
    for (auto& [name, channel] : image.channels) {
        std::size_t i = 0;
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x, ++i)
                if (x < box.x0 || x >= box.x1 || y < box.y0 || y >= box.y1) channel.pixels[i] = 0.0f;
        }
    }
}

// Restricts the comparison to the window that both images have.
void share_window(ImageComparison& images, Selection& selection) {
    const PixelBox all{.x1 = images.ref.width, .y1 = images.ref.height};
    images.common = intersection(images.ref.stored.value_or(all), images.test.stored.value_or(all));
    const PixelBox selected = intersection(*images.common, selection.box.value_or(all));
    if (selected.x0 >= selected.x1 || selected.y0 >= selected.y1)
        throw Error(ExitCode::input_refused, "the images have no pixel in common: their crop windows differ");
    keep_window(images.ref, *images.common);
    keep_window(images.test, *images.common);
    selection.box = selected;
}

}  // namespace

ImageComparison compare_images(Image ref, Image test, Selection selection) {
    ImageComparison result{.ref = std::move(ref), .test = std::move(test)};
    const bool have_one_size =
        result.ref.width == result.test.width && result.ref.height == result.test.height;
    if (have_one_size && (result.ref.stored || result.test.stored)) share_window(result, selection);
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
