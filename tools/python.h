#pragma once

// Python scripts that are part of the binary. They run isolated (-I), so that no module of the current folder
// is imported.

#include <string>
#include <string_view>
#include <vector>

namespace voxilux {

// The first Python that has these modules; empty without one.
[[nodiscard]] std::string python_with(const std::vector<std::string>& modules);

// Runs a program with these arguments and `text` on its standard input. Returns its exit code, or a negative
// errno when it did not start. The standard error of a silent program is dropped.
[[nodiscard]] int run_program(std::vector<std::string> words, std::string_view text, bool is_silent);

// Replaces this process by a Python that runs `script`. The script gets the descriptor of an open file that
// holds `input`, because arguments are limited in length. It handles signals and sets the exit code. Throws
// Error(temporary) when it cannot be started.
[[noreturn]] void become_python(const std::string& python, std::string_view script, std::string_view input);

}  // namespace voxilux
