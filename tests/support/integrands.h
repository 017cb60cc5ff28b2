#pragma once

#include <cmath>

#include <glm/glm.hpp>

namespace voxilux::test {

// Ambient occlusion of a floor point beside a wall without end: the wall stands at distance 1 in the
// direction of azimuth `angle`, from the floor up to `height`. The nearest thing in closed form to what an AO
// ray sees on voxels.
struct WallCorner {
    double angle = 0.0;   // radians
    double height = 1.0;  // wall height / distance

    // 1 where a ray from the origin along `direction` (z up, unit) passes the wall, else 0.
    [[nodiscard]] double visible(glm::vec3 direction) const {
        const double towards = direction.x * std::cos(angle) + direction.y * std::sin(angle);
        return towards > 0.0 && direction.z < height * towards ? 0.0 : 1.0;
    }

    // Cosine-weighted mean of visible(): 1 minus the form factor (1 - sin a) / 2 of a strip without end that
    // is seen from the angle a off the floor normal down to the floor (Howell, catalogue of configuration
    // factors, B-3).
    [[nodiscard]] double mean() const { return 1.0 - 0.5 * (1.0 - 1.0 / std::sqrt(1.0 + height * height)); }
};

// exp(x + y) over the unit square: smooth, mean (e - 1)^2.
inline double smooth_integrand(glm::vec2 u) {
    return std::exp(static_cast<double>(u.x) + static_cast<double>(u.y));
}
inline double smooth_mean() {
    return std::pow(std::exp(1.0) - 1.0, 2.0);
}

}  // namespace voxilux::test
