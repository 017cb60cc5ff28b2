#pragma once

#include <glm/glm.hpp>

namespace voxilux {

// Sine and cosine of an angle in degrees, exact at the multiples of 90: an axis-aligned view or a sun at the
// zenith has components that are exactly 0 and 1. Valid for every finite angle.
[[nodiscard]] double sin_deg(double angle_deg);
[[nodiscard]] double cos_deg(double angle_deg);

// The unit vector at `azimuth_deg` counter-clockwise from +x seen from above and `elevation_deg` above the
// horizon.
[[nodiscard]] glm::dvec3 direction_from_deg(double azimuth_deg, double elevation_deg);

}  // namespace voxilux
