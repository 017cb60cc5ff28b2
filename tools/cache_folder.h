#pragma once

#include <filesystem>

namespace voxilux {

// Where files go that only save time: $XDG_CACHE_HOME/voxilux, else ~/.cache/voxilux; empty without either.
[[nodiscard]] std::filesystem::path cache_folder();

}  // namespace voxilux
