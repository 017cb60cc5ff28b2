#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "jobs/render_session.h"

namespace voxilux {

// The report of a render, with the documented keys (--json, and the header of the EXR).
[[nodiscard]] nlohmann::ordered_json report_json(const Scene& scene, const RenderOutcome& outcome);

// The frames of a range so far: sums over them, and a row for each.
struct SequenceReport {
    RenderOutcome total;  // without an image; the plan is that of the first frame
    nlohmann::ordered_json frames = nlohmann::ordered_json::array();
};

// Adds a frame whose images are in `files`. Most values are summed; the total has the longest dispatch, the
// fewest samples, the largest error, and the memory of the last frame.
void add_frame(SequenceReport& report, std::int64_t frame, const std::vector<std::string>& files,
               const RenderOutcome& outcome);

// The report of a frame range: the keys of report_json over all frames, and `frames`. `scene_hash` is that of
// the animated scene, `scene` any frame of it.
[[nodiscard]] nlohmann::ordered_json sequence_json(const Scene& scene, std::uint64_t scene_hash,
                                                   const SequenceReport& report);

// The part of the report that does not depend on the clock, the load of the machine or the order of threads:
// what --reproducible stores.
[[nodiscard]] nlohmann::ordered_json reproducible_report_json(const Scene& scene,
                                                              const RenderOutcome& outcome);

// The same part of any report.
[[nodiscard]] nlohmann::ordered_json reproducible_report(const nlohmann::ordered_json& report);

// The report's `error`.
[[nodiscard]] nlohmann::ordered_json error_json(const ErrorEstimate& error);

// An error estimate as text for people.
[[nodiscard]] std::string error_text(const ErrorEstimate& error);

// The report's `denoised`, and the same as text for people.
[[nodiscard]] nlohmann::ordered_json denoised_json(const Denoised& denoised);
[[nodiscard]] std::string denoised_text(const Denoised& denoised);

// The report's `steps`.
[[nodiscard]] nlohmann::ordered_json steps_json(const std::vector<StepTime>& steps);

// The plan in the same terms, before anything ran.
[[nodiscard]] nlohmann::ordered_json plan_json(const Scene& scene, const RenderPlan& plan);

// The report as lines for people.
[[nodiscard]] std::string describe(const RenderOutcome& outcome);

}  // namespace voxilux
