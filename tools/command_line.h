#pragma once

namespace voxilux {

// Parses the arguments and runs the subcommand. Returns the code of the process; usage errors are printed,
// whatever else goes wrong is thrown.
[[nodiscard]] int run_command_line(int argc, const char* const* argv);

}  // namespace voxilux
