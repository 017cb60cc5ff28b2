#pragma once

#include <string>
#include <vector>

#include "view/view_state.h"

namespace voxilux {

// The line that renders what the window shows: `words` are those that `view` was called with, whose INPUT was
// `input`.
[[nodiscard]] std::string render_command(const std::vector<std::string>& words, const std::string& input,
                                         const ViewState& state);

}  // namespace voxilux
