#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "jobs/picture_files.h"
#include "jobs/render_session.h"

namespace voxilux {

// A plan with the predictions of a pilot on the device.
struct PilotedPlan {
    RenderPlan plan;
    nlohmann::ordered_json json;  // plan_json() with `forecast`, `forecasts` and `memory_total`
    std::string text;             // lines for people, to follow the plan
};

// Runs the pilot of a frame for the error target, as a render would, and measures what effects that the user
// has switched off contribute to the image.
[[nodiscard]] PilotedPlan pilot_plan(const Scene& animated, std::int64_t frame, const RenderOptions& options);

}  // namespace voxilux
