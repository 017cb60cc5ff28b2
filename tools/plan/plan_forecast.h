#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "jobs/render_session.h"
#include "render/render.h"

namespace voxilux {

// A plan with what a pilot on the device tells of it.
struct PilotedPlan {
    RenderPlan plan;
    nlohmann::ordered_json json;  // plan_json() with `forecast`, `forecasts` and `memory_total`
    std::string text;             // lines for people, to follow the plan
};

// Runs the pilot of a frame for --error, as render would, and finds what the picture loses by effects that
// the user has switched off.
[[nodiscard]] PilotedPlan pilot_plan(const RenderCommand& command, const Scene& animated, std::int64_t frame,
                                     const RenderOptions& options);

}  // namespace voxilux
