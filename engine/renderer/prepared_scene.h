#pragma once

#include "base/step_times.h"
#include "plan/render_plan.h"
#include "scene/facts.h"
#include "scene/scene.h"
#include "world/lights.h"
#include "world/march_world.h"

namespace voxilux {

// The world of the scene as the march needs it, and the facts and the plan that follow. No device is used:
// boxes grow on it later, unless it is a CPU, whose driver takes several times as long.
struct PreparedScene {
    SceneFacts facts;
    MarchWorld march_world;
    LightList lights;
    RenderPlan plan;
    StepTimes times;  // of what was made anew
};

[[nodiscard]] PreparedScene prepare_scene(const Scene& scene, const PlanRequest& request,
                                          const DeviceLimits& limits);

// The same for a scene with these facts and the voxels of `world` in place of its own.
// `times` are of the steps until here.
[[nodiscard]] PreparedScene prepare_scene(const Scene& scene, const SceneFacts& facts,
                                          const VoxelWorld& world, const PlanRequest& request,
                                          const DeviceLimits& limits, StepTimes times = {});

// Finds where photons start towards mirrors and glass, if the plan may use it, and tells `measured`; else the
// lights keep no such thing.
void aim_photons(const Scene& scene, const SceneFacts& facts, glm::ivec3 origin, const PlanRequest& request,
                 LightList& lights, LightFacts& measured);

}  // namespace voxilux
