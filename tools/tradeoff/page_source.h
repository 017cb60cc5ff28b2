#pragma once

#include <string_view>

namespace voxilux {

// page.py and its parts as one Python script, which the build puts inside the binary.
[[nodiscard]] std::string_view page_source();

}  // namespace voxilux
