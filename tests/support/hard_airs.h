#pragma once

// Atmospheres, heights and suns at their extremes.

#include <cmath>
#include <numbers>
#include <vector>

#include "shared/sampling.h"
#include "shared/sky_view.h"

namespace voxilux::test {

inline gpu::Air earth() {
    return {
        {5.802e-3f, 13.558e-3f, 33.1e-3f}, {0.65e-3f, 1.881e-3f, 0.085e-3f}, 3.996e-3f, 4.44e-3f, 0.8f, 0.3f};
}

inline gpu::SkyParams sky_of(const gpu::Air& air, float height, float sun_elevation_deg,
                             gpu::uint resolution = 16) {
    const float e = sun_elevation_deg * std::numbers::pi_v<float> / 180.0f;
    return {.air = air,
            .height = height,
            .horizon = gpu::horizon_elevation(height),
            .top = height > gpu::kAirTop ? gpu::tangent_elevation(height, height - gpu::kAirTop)
                                         : std::numbers::pi_v<float> / 2.0f,
            .disc_height = gpu::cone_height(0.00465f),
            .sun_direction = {std::cos(e), 0.0f, std::sin(e)},
            .irradiance = glm::vec3(1.0f),
            .resolution = resolution};
}

struct HardAir {
    const char* name;
    gpu::Air air;
};

inline std::vector<HardAir> hard_airs() {
    std::vector<HardAir> airs;
    const auto add = [&](const char* name, auto&& change) {
        gpu::Air air = earth();
        change(air);
        airs.push_back({name, air});
    };
    add("the Earth's", [](gpu::Air&) {});
    add("no air", [](gpu::Air& a) { a.rayleigh = glm::vec3(0.0f); });
    add("no aerosol", [](gpu::Air& a) { a.mie = a.mie_extinction = 0.0f; });
    add("ozone alone", [](gpu::Air& a) { a.rayleigh = glm::vec3(0.0f), a.mie = a.mie_extinction = 0.0f; });
    add("black ground", [](gpu::Air& a) { a.ground_albedo = 0.0f; });
    add("white ground", [](gpu::Air& a) { a.ground_albedo = 1.0f; });
    add("g 0.99", [](gpu::Air& a) { a.mie_g = 0.99f; });
    add("g -0.99", [](gpu::Air& a) { a.mie_g = -0.99f; });
    add("100 times as dense", [](gpu::Air& a) {
        a.rayleigh *= 100.0f, a.ozone *= 100.0f, a.mie *= 100.0f, a.mie_extinction *= 100.0f;
    });
    return airs;
}

// Heights, km: on the ground, just above it, at the top of the air and in space.
inline constexpr float kHardHeights[] = {0.0f, 0.0001f, 0.2f, 99.99f, 100.0f, 400.0f};
inline constexpr float kHardSuns[] = {-90.0f, -18.0f, -5.0f, 0.0f, 0.5f, 90.0f};

}  // namespace voxilux::test
