#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace voxilux {

// The linear value in [0,1] of an 8-bit sRGB component. Source: IEC 61966-2-1, the inverse transfer function.
[[nodiscard]] float linear_from_srgb(std::uint8_t component);

// Linear Rec. 709 of 0xRRGGBB.
[[nodiscard]] glm::vec3 linear_from_srgb_hex(std::uint32_t rrggbb);

}  // namespace voxilux
