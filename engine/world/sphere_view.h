#pragma once

// The walk of shared/sphere_tree.h over a plain array.

#include <span>

#include "shared/gpu_types.h"

namespace voxilux {

struct SphereView {
    std::span<const gpu::SphereNode> nodes;
};

namespace gpu {

inline SphereNode load_sphere_node(const SphereView& view, uint i) {
    return view.nodes[i];
}

}  // namespace gpu
}  // namespace voxilux

#define VX_SPHERES_PARAM const ::voxilux::SphereView &view,
#define VX_SPHERES_ARG view,
#include "shared/sphere_tree.h"
#undef VX_SPHERES_PARAM
#undef VX_SPHERES_ARG
