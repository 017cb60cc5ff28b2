#pragma once

#include "view/view_state.h"

namespace voxilux {

// The panels over the picture, in the current frame of ImGui.
void draw_panels(ViewState& state);

}  // namespace voxilux
