#pragma once

#include <cstdint>
#include <optional>

#include <glm/glm.hpp>

#include "plan/device_limits.h"
#include "scene/photon_settings.h"
#include "world/lights.h"

namespace voxilux {

// What a plan needs to know of where photons start that are to meet mirrors or glass first.
struct AimFacts {
    std::uint32_t maps = 0;
    std::uint32_t cells = 0;  // of all maps
    double power = 0.0;       // as those of LightFacts
    glm::dvec3 max_power{0.0};
    double sun_area = 0.0;  // voxels^2

    bool operator==(const AimFacts&) const = default;
};
[[nodiscard]] AimFacts measure_aims(const PhotonAims& aims);

// What a plan needs to know of the emitters.
struct LightFacts {
    std::uint32_t count = 0;
    double power = 0.0;         // r + g + b of radiance times etendue, summed
    glm::dvec3 max_power{0.0};  // of all photons together, if each were as strong as the strongest
    SunDisc sun_disc;
    double extent = 0.0;  // largest magnitude of a coordinate that a photon can meet, local to the world
    std::optional<AimFacts> aims;  // where photons serve caustics alone

    bool operator==(const LightFacts&) const = default;
};

[[nodiscard]] LightFacts measure_lights(const Scene& scene, const LightList& lights, glm::ivec3 world_size,
                                        glm::ivec3 origin);

// How photons run. All zero when none do.
struct PhotonPlan {
    std::uint32_t emitter_photons = 0;  // emitted per iteration
    std::uint32_t sun_photons = 0;
    std::uint32_t at_once = 0;        // of all these, traced and gathered together: one run of photons
    std::uint32_t lanes = 0;          // invocations that trace a run
    std::uint32_t capacity = 0;       // photons that can be stored in a run
    std::uint32_t slots_at_once = 0;  // of these that an invocation reserves together
    std::uint32_t buckets = 0;        // that they are sorted into, a power of two
    std::uint32_t gather_lanes = 0;  // invocations of a subgroup that fetch photons; 0: only the device knows
    bool aims = false;               // they start where they can meet mirrors or glass first
    double power = 0.0;              // of all of them, W: of red, green and blue together
    double power_left_out = 0.0;     // W, of what cannot meet mirrors or glass first
    glm::dvec3 max_power{0.0};       // of one photon, W
    double radius = 0.0;             // of the first iteration, voxels; 0: a pilot has to find it

    bool operator==(const PhotonPlan&) const = default;
    [[nodiscard]] std::uint32_t count() const { return emitter_photons + sun_photons; }
    [[nodiscard]] bool runs() const { return count() != 0; }
    // Runs of photons in an iteration.
    [[nodiscard]] std::uint32_t run_count() const { return (count() + at_once - 1) / at_once; }
};

// What the plan of photons depends on besides the settings.
struct PhotonNeeds {
    LightFacts lights;
    bool has_emitters = false;
    bool has_sun = false;
    bool keeps_indirect = false;
    glm::vec3 sun_irradiance{0.0f};
    std::uint64_t pixels = 0;
    double max_albedo = 0.0;     // of a diffuse material that is used
    double sphere_visits = 0.0;  // of a ray that looks for spheres
    bool has_voxels = false;
    std::uint64_t store_bytes = 0;  // that the photons of a run may take
};

// PhotonPlan::gather_lanes of a device.
[[nodiscard]] std::uint32_t gather_lanes(const DeviceLimits& limits);

// Photons go in as many runs as their store needs.
[[nodiscard]] PhotonPlan plan_photons(const PhotonSettings& settings, const PhotonNeeds& needs,
                                      const DeviceLimits& limits);

}  // namespace voxilux
