#pragma once

#include <filesystem>

namespace voxilux {

// Where files go that only save time, and files that remember what was done: $XDG_CACHE_HOME/voxilux or
// ~/.cache/voxilux, $XDG_STATE_HOME/voxilux or ~/.local/state/voxilux; empty without either.
[[nodiscard]] std::filesystem::path cache_folder();
[[nodiscard]] std::filesystem::path state_folder();

}  // namespace voxilux
