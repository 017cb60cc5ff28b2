#pragma once

#include <string>

namespace voxilux {

// A hash of the running program's own file: equal for copies of one build, different between builds.
// "unknown" where the system does not expose the file.
[[nodiscard]] const std::string& build_id();

}  // namespace voxilux
