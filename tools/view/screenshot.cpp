#include "view/screenshot.h"

#include <array>
#include <string>
#include <utility>

#include "base/colour.h"
#include "base/file.h"
#include "film/film_sums.h"
#include "formats/image_file.h"

namespace voxilux {
namespace {

// For write_png.
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

}  // namespace

void write_screenshots(const WindowCapture& capture, ViewState& state) {
    for (const std::string& file : std::exchange(state.screenshots, {})) {
        if (has_ending(file, ".exr")) {
            if (state.picture.is_loaded())
                write_image(file, picture_of(state.picture.renderer().read_film()));
        } else {
            write_image(file, image_of(capture));
        }
    }
}

}  // namespace voxilux
