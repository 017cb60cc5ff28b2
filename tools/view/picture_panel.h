#pragma once

#include "view/view_state.h"

namespace voxilux {

// How the film is shown, with a legend for false colours, and what is under the pointer.
void draw_picture_panel(ViewState& state);

// The tools that change voxels, and the cells that the chosen one would change.
void draw_edit_panel(ViewState& state);
void draw_target(glm::ivec2 window, const ViewState& state);

// The line between the picture and the reference.
void draw_divider(glm::ivec2 window, const ViewState& state);

}  // namespace voxilux
