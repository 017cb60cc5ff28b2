#pragma once

#include <filesystem>

namespace voxilux {

// The folders of caches and of records of past renders: $XDG_CACHE_HOME/voxilux or ~/.cache/voxilux, and
// $XDG_STATE_HOME/voxilux or ~/.local/state/voxilux. Empty where the environment names neither.
[[nodiscard]] std::filesystem::path cache_folder();
[[nodiscard]] std::filesystem::path state_folder();

}  // namespace voxilux
