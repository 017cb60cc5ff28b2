#pragma once

#include "passes/plane.h"
#include "scene/scene.h"

namespace voxilux {

// The table of an atmosphere and its parameters, for shaders that look directions up (lib/sky.glsl); without
// one, what such a shader leaves alone.
[[nodiscard]] std::vector<Binding> sky_bindings(const RenderPlan& plan, Recording& recording);

// The parameters of an atmosphere, and the table of the light that arrives anywhere in its air.
[[nodiscard]] std::string sky_params_buffer(Recording& recording);
[[nodiscard]] std::string scatter_buffer(const RenderPlan& plan, Recording& recording);

// Builds what an atmosphere looks like from the scene, for all frames under this sun: its parameters, the
// table of its radiance, and the distributions from which rays towards it are drawn, or where no such rays
// are, the irradiance of the six faces. Nothing where the plan has none.
void record_sky_build(const RenderPlan& plan, const Scene& scene, Recording& recording);

// Whether rays find the light of the atmosphere together with its occlusion. Otherwise occlusion comes first,
// or paths find that light.
[[nodiscard]] bool traces_sky(const RenderPlan& plan);

struct SkyPlanes {
    Plane light;  // radiance where the hit is a miss, else irradiance over pi
    Plane ao;     // share of the sky in sight
};

// The atmosphere at each hit by rays, where traces_sky().
[[nodiscard]] SkyPlanes record_sky_trace(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                                         Recording& recording);

// The same by the share of the sky in sight: biased, as all of the sky counts for what is in sight.
[[nodiscard]] Plane record_sky_resolve(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                                       const Plane& ao, Recording& recording);

}  // namespace voxilux
