#include "plan/plan_photons.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "base/checked_cast.h"
#include "shared/light.h"
#include "shared/photon_types.h"

namespace voxilux {
namespace {

// Photons that one invocation traces on a CPU. Path lengths vary, and eight invocations together take as long
// as the longest of them; over so many paths, the sums of lengths are within a few percent of each other.
constexpr double kPhotonsPerLane = 128.0;
// Loop iterations that one invocation is expected to take at most: a quarter of what lavapipe allows.
constexpr double kLaneTurns = 16384.0;
constexpr double kMarchTurns = 32.0;  // of a ray through voxels
constexpr std::uint32_t kMinPhotons = 1u << 14;
constexpr std::uint32_t kMaxPhotons = 1u << 24;
// With fewer photons, the number of stored ones may by chance exceed the expected one by more than
// kStoreMargin.
constexpr std::uint32_t kFewestAtOnce = 1u << 12;
constexpr std::uint32_t kMinBuckets = 1u << 10;
constexpr std::uint32_t kMaxBuckets = 1u << 22;
// Places in the store that an invocation reserves together where it traces many photons.
constexpr std::uint32_t kSlotsAtOnce = 16;
constexpr std::uint32_t kMaxGatherLanes = 32;
constexpr std::uint64_t kCellsPerPixel = 4;  // twice as many buckets gain nothing
// The expected number of surfaces that receive a photon is a geometric series in the albedo; the relative
// deviation of the sum over all photons is far below a half.
constexpr double kStoreMargin = 1.5;
constexpr double kMaxStored = 64.0;
// Over the rounding of a photon's power on the device, six products: no photon may seem to pass the most.
constexpr double kPowerMargin = 1.0 + 0x1p-20;
// Of the power of all photons: to leave out less gains nothing (lab/notes/photons.md).
constexpr double kLeastLeftOut = 0.1;

// What photons carry, W.
struct PhotonSources {
    glm::dvec3 sun{0.0};
    double emitters = 0.0;      // of red, green and blue together
    glm::dvec3 max_power{0.0};  // as LightFacts::max_power

    [[nodiscard]] double of_sun() const { return sun.x + sun.y + sun.z; }
    [[nodiscard]] double total() const { return of_sun() + emitters; }
};

PhotonSources sources_of(const PhotonNeeds& needs, double sun_area, double power,
                         const glm::dvec3& max_power) {
    PhotonSources sources;
    if (needs.has_sun) sources.sun = glm::dvec3(needs.sun_irradiance) * sun_area;
    if (needs.has_emitters) sources.emitters = power;
    sources.max_power = max_power;
    return sources;
}

// From anywhere, and aimed where that leaves out much.
PhotonSources choose_sources(const PhotonNeeds& needs, PhotonPlan& plan) {
    const LightFacts& lights = needs.lights;
    const double disc_area = std::numbers::pi * lights.sun_disc.radius * lights.sun_disc.radius;
    const PhotonSources all = sources_of(needs, disc_area, lights.power, lights.max_power);
    plan.power = all.total();
    if (!lights.aims) return all;
    const PhotonSources aimed =
        sources_of(needs, lights.aims->sun_area, lights.aims->power, lights.aims->max_power);
    if (aimed.total() > (1.0 - kLeastLeftOut) * all.total()) return all;
    plan.aims = true;
    plan.power = aimed.total();
    plan.power_left_out = all.total() - aimed.total();
    return aimed;
}

double stored_per_photon(double max_albedo, const PhotonSettings& settings, bool keeps_indirect) {
    if (!keeps_indirect) return 1.0;
    if (!settings.roulette) return settings.depth;  // no path ends before, however dark the surfaces
    const double endless = 1.0 / std::max(1.0 - max_albedo, 1.0 / kMaxStored);
    return std::min(kStoreMargin * endless, kMaxStored);
}

std::uint32_t photons_per_lane(const PhotonNeeds& needs, double segments) {
    const double turns =
        (std::max(needs.sphere_visits, 1.0) + (needs.has_voxels ? kMarchTurns : 0.0)) * segments;
    return static_cast<std::uint32_t>(std::clamp(kLaneTurns / turns, 1.0, kPhotonsPerLane));
}

// At most `most`, which fit in the store.
std::uint32_t wanted_photons(const PhotonSettings& settings, std::uint64_t pixels, double most) {
    if (settings.count != 0) return settings.count;
    const auto wanted = std::clamp<std::uint64_t>(pixels, kMinPhotons, kMaxPhotons);
    return static_cast<std::uint32_t>(std::min(static_cast<double>(wanted), std::floor(most)));
}

// Photons per run, for runs of equal size. Each photon takes a start and `met` places in the store.
std::uint32_t photons_at_once(std::uint32_t wanted, double met, std::uint64_t store_bytes) {
    const double bytes = std::max(met * sizeof(gpu::StoredPhoton), double{sizeof(gpu::PhotonStart)});
    const double most = std::max(static_cast<double>(store_bytes) / bytes, double{kFewestAtOnce});
    const auto runs = static_cast<std::uint32_t>(std::ceil(wanted / most));
    return (wanted + runs - 1) / runs;
}

// No more than stored photons, and enough for the cells that the kernels of the visible points touch, which
// are mostly the same for neighbours.
std::uint32_t bucket_count(std::uint32_t capacity, std::uint64_t pixels) {
    const std::uint64_t cells = std::min<std::uint64_t>(capacity, kCellsPerPixel * pixels);
    const std::uint64_t most = kMaxBuckets;
    return static_cast<std::uint32_t>(std::bit_ceil(std::clamp<std::uint64_t>(cells, kMinBuckets, most)));
}

}  // namespace

std::uint32_t gather_lanes(const DeviceLimits& limits) {
    return limits.is_cpu ? std::min(limits.subgroup_size, kMaxGatherLanes) : 0;
}

AimFacts measure_aims(const PhotonAims& aims) {
    return {.maps = checked_cast<std::uint32_t>(aims.maps.size(), "maps of photons"),
            .cells = checked_cast<std::uint32_t>(aims.cells.size(), "cells of photons"),
            .power = aims.power,
            .max_power = aims.max_power,
            .sun_area = aims.sun_area};
}

LightFacts measure_lights(const Scene& scene, const LightList& lights, glm::ivec3 world_size,
                          glm::ivec3 origin) {
    LightFacts facts{.count = static_cast<std::uint32_t>(lights.records.size()),
                     .power = lights.power,
                     .max_power = lights.max_power,
                     .sun_disc = lights.sun_disc};
    facts.extent = std::max({world_size.x, world_size.y, world_size.z, 1});
    for (const Sphere& sphere : scene.spheres) {
        const glm::dvec3 far = glm::abs(sphere.centre - glm::dvec3(origin)) + sphere.radius;
        facts.extent = std::max({facts.extent, far.x, far.y, far.z});
    }
    return facts;
}

PhotonPlan plan_photons(const PhotonSettings& settings, const PhotonNeeds& needs,
                        const DeviceLimits& limits) {
    PhotonPlan plan;
    const PhotonSources sources = choose_sources(needs, plan);
    if (!(sources.total() > 0.0)) return {};
    const double met = stored_per_photon(needs.max_albedo, settings, needs.keeps_indirect);
    const double room = static_cast<double>(limits.max_binding_bytes) / sizeof(gpu::StoredPhoton);
    const std::uint32_t wanted = wanted_photons(settings, needs.pixels, room / met);
    plan.sun_photons = static_cast<std::uint32_t>(std::lround(wanted * (sources.of_sun() / sources.total())));
    plan.emitter_photons = wanted - plan.sun_photons;
    plan.at_once = photons_at_once(wanted, met, needs.store_bytes);
    const std::uint32_t per_lane = limits.is_cpu ? photons_per_lane(needs, met) : 1;
    plan.lanes = (plan.at_once + per_lane - 1) / per_lane;
    plan.gather_lanes = gather_lanes(limits);
    plan.radius = settings.radius.value_or(0.0);
    plan.slots_at_once = per_lane > 1 ? kSlotsAtOnce : 1;
    // Each invocation leaves fewer than slots_at_once places empty.
    const double slots = plan.at_once * met + static_cast<double>(plan.lanes) * (plan.slots_at_once - 1);
    plan.capacity = static_cast<std::uint32_t>(std::min(slots, room));
    plan.buckets = bucket_count(plan.capacity, needs.pixels);
    if (plan.emitter_photons != 0)
        plan.max_power = sources.max_power / static_cast<double>(plan.emitter_photons);
    if (plan.sun_photons != 0)
        plan.max_power = glm::max(plan.max_power, sources.sun / static_cast<double>(plan.sun_photons));
    plan.max_power *= kPowerMargin;
    return plan;
}

}  // namespace voxilux
