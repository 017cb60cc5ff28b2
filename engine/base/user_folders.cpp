#include "base/user_folders.h"

#include <cstdlib>

namespace voxilux {
namespace {

std::filesystem::path folder_of(const char* variable, const char* in_home) {
    if (const char* named = std::getenv(variable); named != nullptr && *named != '\0')
        return std::filesystem::path(named) / "voxilux";
    if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
        return std::filesystem::path(home) / in_home / "voxilux";
    return {};
}

}  // namespace

std::filesystem::path cache_folder() {
    return folder_of("XDG_CACHE_HOME", ".cache");
}

std::filesystem::path state_folder() {
    return folder_of("XDG_STATE_HOME", ".local/state");
}

}  // namespace voxilux
