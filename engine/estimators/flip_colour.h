#pragma once

#include <array>

namespace voxilux::flip_colour {

using Vec3 = std::array<double, 3>;

// YCxCz of a linear RGB colour, and back: a linear opponent space with Y in [0,100] whose axes match those of
// CIELab.
[[nodiscard]] Vec3 opponent_of(const Vec3& rgb);
[[nodiscard]] Vec3 rgb_of(const Vec3& opponent);

// CIELab of a linear RGB colour with the Hunt adjustment: chroma fades as the colour gets dark.
[[nodiscard]] Vec3 hunt_lab_of(const Vec3& rgb);

}  // namespace voxilux::flip_colour
