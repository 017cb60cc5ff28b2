#pragma once

#include <functional>
#include <string>
#include <vector>

namespace voxilux {

class Flags;

// Parses the arguments and runs the subcommand. Returns the code of the process; usage errors are printed,
// whatever else goes wrong is thrown.
[[nodiscard]] int run_command_line(int argc, const char* const* argv);

// Parses the words after the name of a subcommand into what its flags write to. For callers that run the
// subcommand's parts themselves. Throws Error(usage).
void parse_words(std::vector<std::string> words, const std::function<void(Flags&)>& add_flags);

}  // namespace voxilux
