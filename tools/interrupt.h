#pragma once

#include <atomic>

namespace voxilux {

// From the first call on, SIGINT and SIGTERM set this: the command is to end soon and in order. The second
// signal ends the process.
[[nodiscard]] const std::atomic<bool>& interrupted_by_signal();

}  // namespace voxilux
