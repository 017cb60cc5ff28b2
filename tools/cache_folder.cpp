#include "cache_folder.h"

#include <cstdlib>

namespace voxilux {

std::filesystem::path cache_folder() {
    if (const char* named = std::getenv("XDG_CACHE_HOME"); named != nullptr && *named != '\0')
        return std::filesystem::path(named) / "voxilux";
    if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
        return std::filesystem::path(home) / ".cache" / "voxilux";
    return {};
}

}  // namespace voxilux
