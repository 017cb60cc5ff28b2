#pragma once

// Python scripts that are part of the binary. They run isolated (-I): else a module that lies in the current
// folder would run.

#include <string>
#include <string_view>
#include <vector>

namespace voxilux {

// The first Python that has these modules; empty without one.
[[nodiscard]] std::string python_with(const std::vector<std::string>& modules);

// Starts a program with these words and `text` on its standard input; its exit code, or an errno as a
// negative number when it did not start. A silent one has no standard error.
[[nodiscard]] int run_program(std::vector<std::string> words, std::string_view text, bool is_silent);

// Replaces this process by a Python that runs `script`, which gets the number of an open file that holds
// `input`: an argument would have to be short. Signals and the exit code are the script's. Throws
// Error(temporary) when it cannot be started.
[[noreturn]] void become_python(const std::string& python, std::string_view script, std::string_view input);

}  // namespace voxilux
