#pragma once

#include "passes/plane.h"
#include "scene/scene.h"

namespace voxilux {

// The table of an atmosphere and its parameters, or an image, for shaders that look directions up
// (lib/sky.glsl, lib/sky_image.glsl), or placeholders where there is none.
[[nodiscard]] std::vector<Binding> sky_bindings(const RenderPlan& plan, Recording& recording);

// The parameters of an atmosphere, and the table of the light that arrives anywhere in its air.
[[nodiscard]] std::string sky_params_buffer(Recording& recording);
[[nodiscard]] std::string scatter_buffer(const RenderPlan& plan, Recording& recording);
// Irradiance / pi of the six faces, for techniques that find visibility separately.
[[nodiscard]] std::string sky_faces_buffer(const RenderPlan& plan, Recording& recording);

// Builds, once for all frames under this sun, what an atmosphere looks like from the scene: its parameters,
// the table of its radiance, and the distributions from which rays towards it are drawn or, where no such
// rays are traced, the irradiance of the six faces. Uploads an image of the sky with its own distribution.
// Records nothing where the plan has neither.
void record_sky_build(const RenderPlan& plan, const Scene& scene, Recording& recording);

// Whether rays find the light of the atmosphere or image together with its occlusion. Otherwise occlusion is
// found first, or paths find that light.
[[nodiscard]] bool traces_sky(const RenderPlan& plan);

struct SkyPlanes {
    Plane light;  // radiance where the hit is a miss, else irradiance / pi
    Plane ao;     // fraction of the sky that is visible
};

// The atmosphere at each hit by rays, where traces_sky().
[[nodiscard]] SkyPlanes record_sky_trace(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                                         Recording& recording);

// The same from ambient visibility: biased, because the mean of the whole sky stands for its visible part.
[[nodiscard]] Plane record_sky_resolve(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                                       const Plane& ao, Recording& recording);

}  // namespace voxilux
