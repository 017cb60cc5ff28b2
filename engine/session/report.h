#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "session/render_session.h"

namespace voxilux {

// The report of a render, with the keys that the command line promises (--json, and the header of the EXR).
[[nodiscard]] nlohmann::ordered_json report_json(const Scene& scene, const RenderOutcome& outcome);

// The part of the report that does not depend on the clock or the machine's load: what --reproducible stores.
[[nodiscard]] nlohmann::ordered_json reproducible_report_json(const Scene& scene,
                                                              const RenderOutcome& outcome);

// The plan in the same terms, before anything ran.
[[nodiscard]] nlohmann::ordered_json plan_json(const Scene& scene, const RenderPlan& plan);

// The report as lines for people.
[[nodiscard]] std::string describe(const RenderOutcome& outcome);

}  // namespace voxilux
