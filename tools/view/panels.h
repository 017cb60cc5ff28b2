#pragma once

#include "view/view_state.h"

namespace voxilux {

// Begins a panel below those that its side of the window has already; end_panel() ends it.
void begin_panel(const char* title, PanelSide side, const ViewState& state);
void end_panel(PanelSide side, ViewState& state);

// The panels over the picture, in the current frame of ImGui.
void draw_panels(glm::ivec2 window, ViewState& state);

}  // namespace voxilux
