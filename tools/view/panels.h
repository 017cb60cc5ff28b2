#pragma once

#include "view/view_state.h"

namespace voxilux {

// Begins a panel at a place of the window, from its left or right edge; ImGui::End() ends it.
void begin_panel(const char* title, glm::vec2 place, bool is_right = false);

// The panels over the picture, in the current frame of ImGui.
void draw_panels(glm::ivec2 window, ViewState& state);

}  // namespace voxilux
