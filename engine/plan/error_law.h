#pragma once

#include "estimators/error_curve.h"
#include "plan/render_plan.h"

namespace voxilux {

// How the noise and the bias of this plan may fall.
[[nodiscard]] ErrorLaw error_law(const RenderPlan& plan);

}  // namespace voxilux
