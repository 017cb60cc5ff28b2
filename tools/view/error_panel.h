#pragma once

#include "view/view_state.h"

namespace voxilux {

// The error in words: "error 3 % after 16 samples; 1 % in about 40 s".
[[nodiscard]] std::string forecast_line(const LiveErrors& errors, double target);

// How the error falls with time, when it will be low enough, and what ends the samples.
void draw_error_panel(ViewState& state);

}  // namespace voxilux
