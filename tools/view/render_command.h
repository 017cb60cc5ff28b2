#pragma once

#include <string>
#include <vector>

#include "view/view_state.h"

namespace voxilux {

// The command line that renders what the window shows, except for unsaved edits. `words` are those that
// `view` was called with, and `input` is its INPUT. Throws Error(usage) where there is no such line: while
// something moves, and for a field of view that --viewpoint does not take.
[[nodiscard]] std::string render_command(const std::vector<std::string>& words, const std::string& input,
                                         const ViewState& state);

}  // namespace voxilux
