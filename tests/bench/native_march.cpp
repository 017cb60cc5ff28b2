#include "bench/native_march.h"

#include "base/assert.h"

namespace voxilux::gpu {
namespace {

// The arrays of a structure that is known when the march is compiled.
template <uint traversal>
struct NativeWorld {
    static constexpr uint kTraversal = traversal;
    const uint* roots;
    const uint* nodes;
    const uint* leaves;
};

template <uint traversal>
uint load_root(const NativeWorld<traversal>& native_world, uint i) {
    return native_world.roots[i];
}
template <uint traversal>
uint load_node(const NativeWorld<traversal>& native_world, uint i) {
    return native_world.nodes[i];
}
template <uint traversal>
uint load_leaf(const NativeWorld<traversal>& native_world, uint i) {
    return native_world.leaves[i];
}

}  // namespace
}  // namespace voxilux::gpu

#define VX_WORLD_PARAM const auto &native_world,
#define VX_WORLD_ARG native_world,
#define VX_TRAVERSAL native_world.kTraversal
#include "shared/camera.h"

namespace voxilux {
namespace {

template <gpu::uint traversal>
void march_all(const MarchWorld& world, std::span<const gpu::Ray> rays, std::span<gpu::BenchHit> hits) {
    const gpu::NativeWorld<traversal> native{world.roots.data(), world.nodes.data(), world.leaves.data()};
    for (std::size_t i = 0; i < rays.size(); ++i) {
        hits[i] = {.cell = glm::ivec3(-1), .face = gpu::kFaceMiss};
        const gpu::WorldEntry entry = gpu::enter_world(rays[i], world.size());
        if (!entry.enters) continue;
        const gpu::MarchHit hit = gpu::march(native, entry.ray, world.chunks_size);
        hits[i] = {.cell = hit.cell, .face = hit.face, .t = entry.t + hit.t, .steps = hit.steps};
    }
}

}  // namespace

void march_native(const MarchWorld& world, std::span<const gpu::Ray> rays, std::span<gpu::BenchHit> hits) {
    switch (world.traversal) {
        case Traversal::naadf:
            return march_all<gpu::kTraversalNaadf>(world, rays, hits);
        case Traversal::deep:
            return march_all<gpu::kTraversalDeep>(world, rays, hits);
        case Traversal::wide:
            return march_all<gpu::kTraversalWide>(world, rays, hits);
        default:
            throw InternalError("internal error: no native march through this structure");
    }
}

}  // namespace voxilux
