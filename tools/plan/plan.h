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

// Prints what render would do with the same flags, and what not and why. Needs a device for --error alone,
// whose time, memory and samples a pilot tells.
[[nodiscard]] int run_plan(const PlanCommand& command);

}  // namespace voxilux
