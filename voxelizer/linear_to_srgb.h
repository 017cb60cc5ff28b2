#pragma once

#include <glm/glm.hpp>

namespace voxilux {

// The nearest sRGB bytes (IEC 61966-2-1) of a linear colour, clamped to [0, 1]. By table, with the same
// results as rounding the formula.
[[nodiscard]] glm::u8vec3 srgb_bytes(glm::vec3 linear);

}  // namespace voxilux
