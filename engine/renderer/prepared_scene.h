#pragma once

#include "plan/render_plan.h"
#include "scene/facts.h"
#include "scene/scene.h"
#include "world/lights.h"
#include "world/march_world.h"

namespace voxilux {

// The world of a scene as the march needs it, with its facts, lights and plan. Made without a device.
struct PreparedScene {
    SceneFacts facts;
    MarchWorld march_world;
    LightList lights;
    RenderPlan plan;
};

[[nodiscard]] PreparedScene prepare_scene(const Scene& scene, const PlanRequest& request,
                                          const DeviceLimits& limits);

// The same for a scene with these facts and the voxels of `world` in place of its own.
[[nodiscard]] PreparedScene prepare_scene(const Scene& scene, const SceneFacts& facts,
                                          const VoxelWorld& world, const PlanRequest& request,
                                          const DeviceLimits& limits);

}  // namespace voxilux
