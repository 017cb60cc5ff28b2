#include "plan/plan_photons.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "shared/light.h"
#include "shared/photon_types.h"

namespace voxilux {
namespace {

// Photons that one invocation traces on a CPU: a path's length varies, and what eight invocations do together
// takes as long as the longest of them; over so many paths the sums of the lengths are within a few percent.
constexpr std::uint32_t kPhotonsPerLane = 32;
constexpr std::uint32_t kFewestPhotons = 1u << 14;
constexpr std::uint32_t kMostPhotons = 1u << 24;
constexpr std::uint32_t kMostBuckets = 1u << 22;
// Surfaces that receive a photon are a geometric series in the albedo; the deviation of their sum over all
// photons is far below a half. Below: of photons that bounce between caustics only.
constexpr double kStoreMargin = 1.5;
constexpr double kMostStored = 64.0;
constexpr double kDefaultRadius = 1.0;

double stored_per_photon(double most_albedo, const PhotonSettings& settings, bool keeps_indirect) {
    if (!keeps_indirect) return 1.0;
    const double endless = 1.0 / std::max(1.0 - most_albedo, 1.0 / kMostStored);
    const double deep = settings.roulette ? kMostStored : static_cast<double>(settings.depth);
    return std::min(kStoreMargin * endless, deep);
}

std::uint32_t wanted_photons(const PhotonSettings& settings, std::uint64_t pixels) {
    if (settings.count != 0) return settings.count;
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(pixels, kFewestPhotons, kMostPhotons));
}

}  // namespace

LightFacts measure_lights(const Scene& scene, const LightList& lights, glm::ivec3 world_size,
                          glm::ivec3 origin) {
    LightFacts facts{.count = static_cast<std::uint32_t>(lights.records.size()),
                     .power = lights.power,
                     .most_power = lights.most_power,
                     .sun_disc = lights.sun_disc};
    facts.extent = std::max({world_size.x, world_size.y, world_size.z, 1});
    for (const Sphere& sphere : scene.spheres) {
        const glm::dvec3 far = glm::abs(sphere.centre - glm::dvec3(origin)) + sphere.radius;
        facts.extent = std::max({facts.extent, far.x, far.y, far.z});
    }
    for (const Material& material : scene.materials)
        facts.most_albedo = std::max(
            facts.most_albedo,
            static_cast<double>(std::max({material.albedo.x, material.albedo.y, material.albedo.z})));
    return facts;
}

PhotonPlan plan_photons(const PhotonSettings& settings, const PhotonNeeds& needs,
                        const DeviceLimits& limits) {
    PhotonPlan plan;
    const double sun_area = std::numbers::pi * needs.lights.sun_disc.radius * needs.lights.sun_disc.radius;
    const glm::dvec3 sun_power = glm::dvec3(needs.sun_irradiance) * sun_area;
    const double sun = needs.has_sun ? sun_power.x + sun_power.y + sun_power.z : 0.0;
    const double lamps = needs.has_lamps ? needs.lights.power : 0.0;
    if (!(sun + lamps > 0.0)) return plan;
    const std::uint32_t wanted = wanted_photons(settings, needs.pixels);
    plan.sun_photons = static_cast<std::uint32_t>(std::lround(wanted * (sun / (sun + lamps))));
    plan.lamp_photons = wanted - plan.sun_photons;
    plan.lanes = limits.is_cpu ? (wanted + kPhotonsPerLane - 1) / kPhotonsPerLane : wanted;
    const double stored =
        wanted * stored_per_photon(needs.lights.most_albedo, settings, needs.keeps_indirect);
    if (stored * sizeof(gpu::StoredPhoton) > static_cast<double>(limits.max_binding_bytes))
        throw Error(ExitCode::input_refused,
                    fmt::format("{} photons in an iteration need room for {:.0f}, more than {} bytes of {}; "
                                "use fewer of them and more iterations",
                                wanted, stored, limits.max_binding_bytes, limits.name));
    plan.radius = settings.radius.value_or(kDefaultRadius);
    plan.capacity = static_cast<std::uint32_t>(stored);
    plan.buckets = std::min(std::bit_ceil(std::max(plan.capacity, 1024u)), kMostBuckets);
    if (plan.lamp_photons != 0)
        plan.most_power = needs.lights.most_power / static_cast<double>(plan.lamp_photons);
    if (plan.sun_photons != 0)
        plan.most_power = glm::max(plan.most_power, sun_power / static_cast<double>(plan.sun_photons));
    return plan;
}

}  // namespace voxilux
