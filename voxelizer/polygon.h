#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace voxilux {

// Cuts a polygon in space into size - 2 triangles of corner indices. A polygon whose corners all turn the
// same way is cut as a fan from its first corner, others by ear clipping (Meisters, Polygons have ears,
// 1975). A polygon of more than kMaxEarCorners corners, and the rest of one that intersects itself, is also
// cut as a fan, so that the time stays bounded.
inline constexpr std::size_t kMaxEarCorners = 256;
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const glm::dvec3> corners);

}  // namespace voxilux
