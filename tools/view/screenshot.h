#pragma once

#include "formats/image.h"
#include "vk/presenter.h"

namespace voxilux {

// What the window showed, as an image for write_png.
[[nodiscard]] Image image_of(const WindowCapture& capture);

}  // namespace voxilux
