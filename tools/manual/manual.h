#pragma once

// The manual page and the completions of shells, made from the flags that the command line has.

#include <string>

#include "manual/command_tree.h"

namespace voxilux {

// voxilux(1) in troff's macros of man. `exit_codes` are lines of a code and its meaning.
[[nodiscard]] std::string man_page(const ManualCommand& root, const std::string& exit_codes);

[[nodiscard]] std::string bash_completion(const ManualCommand& root);
[[nodiscard]] std::string zsh_completion(const ManualCommand& root);
[[nodiscard]] std::string fish_completion(const ManualCommand& root);

}  // namespace voxilux
