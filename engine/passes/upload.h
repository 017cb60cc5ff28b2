#pragma once

#include "plan/render_plan.h"
#include "record/recording.h"
#include "shared/gpu_types.h"

namespace voxilux {

// Puts the scene on the device: world, sky, materials, spheres, emitters, whatever the plan has.
void record_scene_upload(const RenderPlan& plan, const Scene& scene, const MarchWorld& march_world,
                         const LightList& lights, Recording& recording);

// Of the above what depends on which effects run, and not on the voxels: sky, materials, spheres, emitters.
void record_materials_upload(const RenderPlan& plan, const Scene& scene, glm::ivec3 origin,
                             const LightList& lights, Recording& recording);

// Puts the parameters of one tile on the device and sets the counters to zero.
void record_frame_upload(const gpu::FrameParams& params, Recording& recording);

// Sets every film plane to zero.
void record_film_clear(const RenderPlan& plan, Recording& recording);

}  // namespace voxilux
