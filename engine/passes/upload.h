#pragma once

#include "plan/render_plan.h"
#include "record/recording.h"
#include "shared/gpu_types.h"

namespace voxilux {

// Uploads the scene to the device: world, sky, materials, spheres and emitters, as far as the plan has them.
void record_scene_upload(const RenderPlan& plan, const Scene& scene, const MarchWorld& march_world,
                         const LightList& lights, Recording& recording);

// The part of the above that depends on the effects but not on the voxels: sky, materials, spheres, emitters.
void record_materials_upload(const RenderPlan& plan, const Scene& scene, glm::ivec3 origin,
                             const LightList& lights, Recording& recording);

// Uploads the parameters of one tile and clears the counters.
void record_frame_upload(const gpu::FrameParams& params, Recording& recording);

// Sets every film plane to zero.
void record_film_clear(const RenderPlan& plan, Recording& recording);

}  // namespace voxilux
