#pragma once

#include "plan/render_plan.h"

namespace voxilux {

// Every pass of the render with its count, and every buffer with its size; the rest of the plan is made.
void list_passes(RenderPlan& plan);
void list_buffers(RenderPlan& plan);

}  // namespace voxilux
