#pragma once

#include <atomic>

namespace voxilux {

// From the first call on, SIGINT, SIGTERM and SIGHUP set this flag and print a message: the command is to end
// soon and in order. The second signal ends the process. A signal that was ignored stays ignored.
[[nodiscard]] const std::atomic<bool>& interrupted_by_signal();

// From the first call on, SIGUSR1 sets this flag: the command is to save what it has, and to go on. Whoever
// saves clears it.
[[nodiscard]] std::atomic<bool>& checkpoint_wanted_by_signal();

}  // namespace voxilux
