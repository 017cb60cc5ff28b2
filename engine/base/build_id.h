#pragma once

#include <string>

namespace voxilux {

// A hash of the running program's own file: equal for copies of one build, and different for any two builds.
// "unknown" where the system does not show the file.
[[nodiscard]] const std::string& build_id();

}  // namespace voxilux
