#pragma once

#include <optional>
#include <vector>

#include "formats/image.h"
#include "vk/presenter.h"

namespace voxilux {

// What the window showed, as an image for write_png.
[[nodiscard]] Image image_of(const WindowCapture& capture);

// [height][width][3] of an image; nothing where it has no colours.
[[nodiscard]] std::optional<std::vector<float>> interleaved_colours(const Image& image);

}  // namespace voxilux
