#include "scene/angles.h"

#include <cmath>
#include <numbers>

namespace voxilux {

double sin_deg(double angle_deg) {
    const double turn = std::remainder(angle_deg, 360.0);  // exact
    const double quarter = std::nearbyint(turn / 90.0);
    const double rest = (turn - 90.0 * quarter) * (std::numbers::pi / 180.0);
    switch ((static_cast<int>(quarter) + 4) % 4) {
        case 0:
            return std::sin(rest);
        case 1:
            return std::cos(rest);
        case 2:
            return -std::sin(rest);
        default:
            return -std::cos(rest);
    }
}

double cos_deg(double angle_deg) {
    const double turn = std::remainder(angle_deg, 360.0);
    return sin_deg(90.0 - std::abs(turn));
}

glm::dvec3 direction_from_deg(double azimuth_deg, double elevation_deg) {
    const double flat = cos_deg(elevation_deg);
    return {flat * cos_deg(azimuth_deg), flat * sin_deg(azimuth_deg), sin_deg(elevation_deg)};
}

}  // namespace voxilux
