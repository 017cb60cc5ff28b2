#pragma once

// The walk of shared/sphere_tree.h over plain arrays.

#include <span>

#include "shared/gpu_types.h"

namespace voxilux {

struct SphereView {
    std::span<const gpu::SphereNode> nodes;
    std::span<const gpu::SphereRecord> spheres;
};

namespace gpu {

inline SphereNode load_sphere_node(const SphereView& view, uint i) {
    return view.nodes[i];
}

inline Sphere load_sphere(const SphereView& view, uint i) {
    return view.spheres[i].shape;
}

}  // namespace gpu
}  // namespace voxilux

#define VX_SPHERES_PARAM const ::voxilux::SphereView &view,
#define VX_SPHERES_ARG view,
#include "shared/sphere_tree.h"
#undef VX_SPHERES_PARAM
#undef VX_SPHERES_ARG
