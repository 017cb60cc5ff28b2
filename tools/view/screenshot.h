#pragma once

#include "view/view_state.h"
#include "vk/presenter.h"

namespace voxilux {

// Writes the screenshots of this frame: the window as it was shown, or the film (.exr).
void write_screenshots(const WindowCapture& capture, ViewState& state);

}  // namespace voxilux
