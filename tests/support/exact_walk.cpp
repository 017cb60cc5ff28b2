#include "support/exact_walk.h"

#include <cmath>
#include <cstdlib>

#include "base/assert.h"

namespace voxilux::test {
namespace {

// Half voxels from the start to the next plane, in the direction of travel: the plane `crossed` planes
// further on.
std::int64_t halves_to_plane(float fraction, bool forwards, std::int64_t crossed) {
    const auto halves = static_cast<std::int64_t>(std::lround(fraction * 2.0f));
    VX_ASSERT(static_cast<float>(halves) == fraction * 2.0f);
    return 2 * crossed + (forwards ? 2 - halves : halves);
}

}  // namespace

ExactHit exact_walk(const VoxelWorld& world, const gpu::Ray& ray, AxisOrder order) {
    ExactHit hit{.cell = ray.cell};
    glm::i64vec3 crossed(0);
    int last = -1;
    while (world.contains(hit.cell)) {
        if (world.get(hit.cell) != VoxelWorld::kEmpty) {
            if (last < 0) {
                hit.face = gpu::kFaceInside;
            } else {
                hit.face = static_cast<gpu::uint>(2 * last + (ray.direction[last] > 0.0f ? 0 : 1));
            }
            return hit;
        }
        // Time of a crossing is halves / speed; two of them compare by cross products.
        int next = -1;
        std::int64_t next_halves = 0;
        std::int64_t next_speed = 1;
        for (const int a : order) {
            const auto speed = static_cast<std::int64_t>(std::abs(ray.direction[a]));
            if (speed == 0) continue;
            const std::int64_t halves = halves_to_plane(ray.fraction[a], ray.direction[a] > 0.0f, crossed[a]);
            if (next >= 0 && halves * next_speed >= next_halves * speed) continue;
            next = a;
            next_halves = halves;
            next_speed = speed;
        }
        VX_ASSERT(next >= 0);
        ++crossed[next];
        hit.cell[next] += ray.direction[next] > 0.0f ? 1 : -1;
        last = next;
    }
    return hit;
}

}  // namespace voxilux::test
