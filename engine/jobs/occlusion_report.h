#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "jobs/render_session.h"

namespace voxilux {

// How occlusion will be found: method, reason and the slots of its table. Null where it is off; without a
// table the slots are null.
[[nodiscard]] nlohmann::ordered_json planned_occlusion_json(const RenderPlan& plan);

// The same with the use of the table: the live cells at the end, the fraction of slots that they take, the
// keys compared per search, and the fraction of hits that needed no search. Null without a table.
[[nodiscard]] nlohmann::ordered_json occlusion_json(const RenderPlan& plan,
                                                    const RenderStatistics& statistics);

// The same as a line for people; empty without a table.
[[nodiscard]] std::string occlusion_text(const RenderPlan& plan, const RenderStatistics& statistics);

}  // namespace voxilux
