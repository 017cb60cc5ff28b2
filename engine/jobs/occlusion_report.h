#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "jobs/render_session.h"

namespace voxilux {

// How occlusion will be found: method, reason and the slots of its table. Null where it is off; without a
// table the slots are null.
[[nodiscard]] nlohmann::ordered_json planned_occlusion_json(const RenderPlan& plan);

// The same, and how the table served: the cells in it at the end, the share of its slots that they take, how
// many keys a search looked at, and which share of the hits needed no search. Null without a table.
[[nodiscard]] nlohmann::ordered_json occlusion_json(const RenderPlan& plan,
                                                    const RenderStatistics& statistics);

// The same as a line for people; empty without a table.
[[nodiscard]] std::string occlusion_text(const RenderPlan& plan, const RenderStatistics& statistics);

}  // namespace voxilux
