#pragma once

#include "render/render.h"

namespace voxilux {

// The flags of render and those of plan alone.
struct PlanCommand {
    RenderCommand render;
    bool history = false;
};

// Without --history INPUT is needed, too.
void add_plan_flags(Flags& flags, PlanCommand& command);

// Prints what render would do with the same flags, what it would leave out, and why. Only --error needs a
// device: a pilot predicts samples, time and memory.
[[nodiscard]] int run_plan(const PlanCommand& command);

}  // namespace voxilux
