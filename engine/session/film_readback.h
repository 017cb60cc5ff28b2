#pragma once

#include "film/film_sums.h"
#include "plan/render_plan.h"
#include "vk/executor.h"

namespace voxilux {

// Reads the film from the device: every plane that the plan has, bands joined. The caller knows how many
// samples each row has received.
[[nodiscard]] FilmSums read_film(const RenderPlan& plan, Executor& executor);

// As read_film, but only the planes that the error is estimated from.
[[nodiscard]] FilmSums read_error_film(const RenderPlan& plan, Executor& executor);

}  // namespace voxilux
