#pragma once

#include <filesystem>

namespace voxilux {

// Starts the page maker that is inside the binary with `python3 -`: JSON in, one HTML file out, which appears
// whole or not at all. Throws Error(cannot_write) with what to do when python3 or matplotlib is missing or
// the page maker fails.
void make_page(const std::filesystem::path& json, const std::filesystem::path& page);

}  // namespace voxilux
