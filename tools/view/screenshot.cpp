#include "view/screenshot.h"

#include <array>
#include <string>

#include "base/colour.h"

namespace voxilux {

Image image_of(const WindowCapture& capture) {
    const std::array<std::string, 3> names{"R", "G", "B"};
    Image image = make_image(capture.size.x, capture.size.y, names);
    image.display_referred = true;
    const std::array<float, 256> decoded = decoded_srgb_codes();
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<float>& plane = image.channels[names[c]].pixels;
        for (std::size_t i = 0; i < plane.size(); ++i)
            plane[i] = decoded[capture.rgb[3 * i + c]];
    }
    return image;
}

std::optional<std::vector<float>> interleaved_colours(const Image& image) {
    const auto planes = colour_planes(image);
    if (!planes) return std::nullopt;
    std::vector<float> values(3 * pixel_count(image));
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = (*planes)[i % 3][i / 3];
    return values;
}

}  // namespace voxilux
