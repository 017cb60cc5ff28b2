#pragma once

#include <string>
#include <vector>

#include "view/view_state.h"

namespace voxilux {

// The line that renders what the window shows, but for edits that are not saved: `words` are those that
// `view` was called with, whose INPUT was `input`. Throws Error(usage) where there is none: while something
// moves, and for a field of view that --viewpoint does not take.
[[nodiscard]] std::string render_command(const std::vector<std::string>& words, const std::string& input,
                                         const ViewState& state);

}  // namespace voxilux
