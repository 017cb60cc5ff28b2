#pragma once

#include <span>

#include "plan/render_plan.h"
#include "vk/pass_time.h"

namespace voxilux {

// Milliseconds of the passes that an effect needs.
[[nodiscard]] double effect_ms(const RenderPlan& plan, std::span<const PassTime> passes, Effect effect);

}  // namespace voxilux
