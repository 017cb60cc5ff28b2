#pragma once

#include <string>

namespace voxilux {

// What --version prints: version, build, the Vulkan loader that is there, and what this was built with. Asks
// no device, so that it is instant.
[[nodiscard]] std::string version_text();

}  // namespace voxilux
