#include "jobs/bench/ray_checker.h"

#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "world/world_view.h"  // needs the world access that this header gives

#include "shared/camera.h"

namespace voxilux {
namespace {

// One axis of a walk.
struct WalkAxis {
    int step = 0;  // -1, 0 (never crosses) or 1
    float inverse_direction = 0.0f;
    float offset = 0.0f;
    int crossed = 0;

    [[nodiscard]] float next_time() const {
        if (step == 0) return std::numeric_limits<float>::infinity();
        const int planes = crossed + 1 - (step < 0 ? 1 : 0);
        return (static_cast<float>(planes) + offset) * inverse_direction;
    }
};

WalkAxis walk_axis(float direction, float fraction) {
    const float speed = std::abs(direction);
    if (speed < gpu::kMinDirection) return {};
    const int step = direction < 0.0f ? -1 : 1;
    return {.step = step, .inverse_direction = 1.0f / speed, .offset = step < 0 ? fraction : -fraction};
}

}  // namespace

WalkedHit walk_ray(const VoxelWorld& world, const gpu::Ray& ray) {
    std::array<WalkAxis, 3> axes;
    for (int a = 0; a < 3; ++a)
        axes[static_cast<std::size_t>(a)] = walk_axis(ray.direction[a], ray.fraction[a]);
    WalkedHit hit{.cell = ray.cell};
    gpu::uint face = gpu::kFaceInside;
    while (world.contains(hit.cell)) {
        ++hit.cells;
        if (world.get(hit.cell) != VoxelWorld::kEmpty) {
            hit.face = face;
            return hit;
        }
        std::size_t first = 0;
        for (std::size_t a = 1; a < 3; ++a)
            if (axes[a].next_time() < axes[first].next_time()) first = a;
        if (!(axes[first].next_time() < ray.t_max)) return hit;
        WalkAxis& axis = axes[first];
        hit.t = axis.next_time();
        ++axis.crossed;
        hit.cell[static_cast<int>(first)] += axis.step;
        face = static_cast<gpu::uint>(2 * first) + (axis.step < 0 ? 1u : 0u);
    }
    return hit;
}

Verdicts check_rays(const VoxelWorld& world, std::span<const gpu::Ray> rays, std::uint64_t max_cells) {
    Verdicts verdicts;
    if (rays.empty()) return verdicts;
    // Steps of the golden ratio spread the visited entries evenly however early the loop ends; a stride that
    // has no common divisor with the length visits every entry once.
    std::size_t stride = static_cast<std::size_t>(0.6180339887498949 * static_cast<double>(rays.size())) | 1;
    while (std::gcd(stride, rays.size()) != 1)
        ++stride;
    std::uint64_t cells = 0;
    std::size_t at = 0;
    for (std::size_t i = 0; i < rays.size() && (i == 0 || cells < max_cells); ++i) {
        const gpu::WorldEntry entry = gpu::enter_world(rays[at], world.size());
        const WalkedHit hit = entry.enters ? walk_ray(world, entry.ray) : WalkedHit{};
        verdicts.rays.push_back(at);
        verdicts.hits.push_back(hit);
        cells += hit.cells + 1;
        at = (at + stride) % rays.size();
    }
    return verdicts;
}

std::uint64_t count_mismatches(const Verdicts& verdicts, std::span<const gpu::BenchHit> hits) {
    std::uint64_t mismatches = 0;
    for (std::size_t i = 0; i < verdicts.rays.size(); ++i) {
        const WalkedHit& wanted = verdicts.hits[i];
        const gpu::BenchHit& found = hits[verdicts.rays[i]];
        const bool same_cell = wanted.face == gpu::kFaceMiss || wanted.cell == found.cell;
        if (wanted.face != found.face || !same_cell) ++mismatches;
    }
    return mismatches;
}

}  // namespace voxilux
