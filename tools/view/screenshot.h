#pragma once

#include <optional>
#include <vector>

#include "formats/image.h"
#include "view/view_state.h"
#include "vk/presenter.h"

namespace voxilux {

// Writes what is to be taken of this frame: the window as it was shown, or the film (.exr).
void write_screenshots(const WindowCapture& capture, ViewState& state);

// [height][width][3] of an image; nothing where it has no colours.
[[nodiscard]] std::optional<std::vector<float>> interleaved_colours(const Image& image);

}  // namespace voxilux
