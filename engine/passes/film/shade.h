#pragma once

#include "passes/plane.h"

namespace voxilux {

// What shading reads; each may be a constant.
struct ShadeInputs {
    Plane hits;
    Plane ao;
    Plane sky;  // of an atmosphere: what misses see, and what hits receive over pi; else a constant
    Plane sun;
    Plane direct;   // irradiance / pi, of emitters
    Plane photons;  // irradiance, of photons
    Plane weights;  // of what is seen in mirrors and through glass
};

// Linear RGB radiance of each camera ray.
[[nodiscard]] Plane record_shade_resolve(const RenderPlan& plan, const DispatchTile& tile,
                                         const ShadeInputs& inputs, Recording& recording);

}  // namespace voxilux
