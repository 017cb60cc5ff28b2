#pragma once

#include "passes/plane.h"

namespace voxilux {

// A buffer with the time at which the camera rays of each beam tile may start (shaders/shared/beam.h).
[[nodiscard]] std::string record_primary_beam(const RenderPlan& plan, const DispatchTile& tile,
                                              Recording& recording);

// The first voxel along each camera ray.
[[nodiscard]] Plane record_primary_march(const RenderPlan& plan, const DispatchTile& tile,
                                         const std::string& starts, Recording& recording);

}  // namespace voxilux
