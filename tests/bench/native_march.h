#pragma once

#include <span>

#include "shared/gpu_types.h"
#include "world/march_world.h"

namespace voxilux {

// The march of the shaders as scalar C++ for the very processor that compiles it, a ray at a time: how fast
// the same steps are without Vulkan. Hits of `voxilux bench march`, through naadf, deep or wide.
void march_native(const MarchWorld& world, std::span<const gpu::Ray> rays, std::span<gpu::BenchHit> hits);

}  // namespace voxilux
