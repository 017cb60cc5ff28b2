#pragma once

#include <nlohmann/json.hpp>

#include "plan/render_plan.h"

namespace voxilux {

// The object `photons` of reports: {per_iteration, of_lamps, of_sun, power (W, of red, green and blue
// together), power_left_out (W, of light that cannot be caustics), runs, capacity, first_radius (voxels; null
// until a pilot has found it), alpha, method}; null without photons.
[[nodiscard]] nlohmann::ordered_json photons_json(const RenderPlan& plan);

}  // namespace voxilux
