#pragma once

#include "plan/render_plan.h"
#include "scene/facts.h"
#include "scene/scene.h"
#include "world/lights.h"
#include "world/march_world.h"

namespace voxilux {

// The world of the scene as the march needs it, and the facts and the plan that follow. No device is used.
struct PreparedScene {
    SceneFacts facts;
    MarchWorld march_world;
    LightList lights;
    RenderPlan plan;
};

[[nodiscard]] PreparedScene prepare_scene(const Scene& scene, const PlanRequest& request,
                                          const DeviceLimits& limits);

// The same of a scene with these facts whose voxels are those of `world`. The scene's own are not looked at.
[[nodiscard]] PreparedScene prepare_scene(const Scene& scene, const SceneFacts& facts,
                                          const VoxelWorld& world, const PlanRequest& request,
                                          const DeviceLimits& limits);

// Finds where photons start towards mirrors and glass, if the plan may use it, and tells `measured`; else the
// lights keep no such thing.
void aim_photons(const Scene& scene, const SceneFacts& facts, glm::ivec3 origin, const PlanRequest& request,
                 LightList& lights, LightFacts& measured);

}  // namespace voxilux
