#pragma once

#include <cstdlib>
#include <filesystem>

// Path of the shared test data: beside the checkout, or where VOXILUX_SHARED points. Empty when absent.
inline std::filesystem::path shared_data() {
    namespace fs = std::filesystem;
    const char* named = std::getenv("VOXILUX_SHARED");
    const fs::path path =
        named != nullptr ? fs::path(named) : fs::path(VX_SOURCE_DIR).parent_path() / "shared";
    return fs::is_directory(path) ? path : fs::path();
}

#define SKIP_WITHOUT_SHARED_DATA()                                  \
    if (shared_data().empty())                                      \
    GTEST_SKIP() << "no shared test data beside the checkout (set " \
                    "VOXILUX_SHARED)"
