#pragma once

// The C++ side of shaders/shared/march.h, beam.h and grow_distances.h: they read a MarchWorld where the
// shader reads its buffers.

#include "world/march_world.h"

namespace voxilux::gpu {

inline std::uint32_t load_root(const MarchWorld& march_world, std::uint32_t i) {
    return march_world.roots[i];
}
inline std::uint32_t load_node(const MarchWorld& march_world, std::uint32_t i) {
    return march_world.nodes[i];
}
inline std::uint32_t load_leaf(const MarchWorld& march_world, std::uint32_t i) {
    return march_world.leaves[i];
}

}  // namespace voxilux::gpu

#define VX_WORLD_PARAM const ::voxilux::MarchWorld &march_world,
#define VX_WORLD_ARG march_world,
#define VX_TRAVERSAL static_cast<::voxilux::gpu::uint>(march_world.traversal)
#include "shared/beam.h"
#include "shared/grow_distances.h"
#include "shared/march.h"
#undef VX_WORLD_PARAM
#undef VX_WORLD_ARG
#undef VX_TRAVERSAL
