#pragma once

#include "film/film_sums.h"
#include "plan/render_plan.h"
#include "vk/executor.h"

namespace voxilux {

// Reads the film from the device: every plane that the plan has, film tiles joined. The caller knows how many
// samples each row has received.
[[nodiscard]] FilmSums read_film(const RenderPlan& plan, Executor& executor);

// Rows of the image that lie in one film tile.
struct RowRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

// At most `count` rows around the middle of the image.
[[nodiscard]] RowRange middle_rows(const RenderPlan& plan, std::uint32_t count);

// As read_film, but only these rows: a film of that height.
[[nodiscard]] FilmSums read_film_rows(const RenderPlan& plan, RowRange rows, Executor& executor);

// As read_film, but only the planes that the error is estimated from.
[[nodiscard]] FilmSums read_error_film(const RenderPlan& plan, Executor& executor);

}  // namespace voxilux
