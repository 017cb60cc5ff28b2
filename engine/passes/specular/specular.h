#pragma once

#include "passes/plane.h"

namespace voxilux {

// What the camera sees through mirrors and glass: the hits there, and the factor of their radiance.
struct SpecularPlanes {
    Plane hits;
    Plane weights;
};

[[nodiscard]] SpecularPlanes record_specular_trace(const RenderPlan& plan, const DispatchTile& tile,
                                                   const Plane& first_hits, Recording& recording);

// Bindings and constants of every pass that follows paths (shaders/lib/path.glsl), the frame and the counters
// included.
[[nodiscard]] std::vector<Binding> path_bindings(const RenderPlan& plan, Recording& recording);
[[nodiscard]] std::vector<Constant> path_constants(const RenderPlan& plan);

}  // namespace voxilux
