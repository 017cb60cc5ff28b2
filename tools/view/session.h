#pragma once

#include "jobs/frame_list.h"
#include "view/script.h"
#include "view/view.h"

namespace voxilux {

// Opens the window and runs it until it is closed, the script has ended or --frames are shown.
[[nodiscard]] int run_session(const ViewCommand& command);

}  // namespace voxilux
