#pragma once

#include "plan/render_plan.h"
#include "scene/facts.h"

namespace voxilux {

// Adds to a plan what its image will lack: by simplification (RenderPlan::notes) and without the effects that
// were switched off (RenderPlan::without).
void add_notes(RenderPlan& plan, const SceneFacts& facts);

}  // namespace voxilux
