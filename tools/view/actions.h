#pragma once

#include <string_view>
#include <utility>

#include "view/view_state.h"

namespace voxilux {

// What an event does to the view, when no panel wants it.
void take_event(const InputEvent& event, glm::ivec2 window, ViewState& state);

// Moves the camera as the held keys say, for so many seconds.
void fly(double seconds, ViewState& state);

// The key sheet: keys and what they do.
[[nodiscard]] std::span<const std::pair<const char*, const char*>> key_sheet();

}  // namespace voxilux
