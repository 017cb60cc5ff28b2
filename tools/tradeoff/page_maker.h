#pragma once

#include <filesystem>
#include <string_view>

namespace voxilux {

// Starts the page maker that is inside the binary with `python3 -I -`: JSON in, one HTML file out, which
// appears whole or not at all. Throws Error(cannot_write) with what to do when python3 or matplotlib is
// missing or the page maker fails.
void make_page(const std::filesystem::path& json, const std::filesystem::path& page);

// page.py and its parts as one Python script, which the build puts inside the binary.
[[nodiscard]] std::string_view page_source();

}  // namespace voxilux
