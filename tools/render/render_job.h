#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "jobs/frame_range.h"
#include "progress_line.h"
#include "render/render.h"

namespace voxilux {

// What a command line asks of a session.
struct RenderJob {
    const Checkpoint& checkpoint;
    FrameRangeJob range;  // of one frame for a picture
    ProgressLine& progress;
    std::uint64_t scene_hash = 0;  // of the animated scene
};

struct RenderedFrames {
    ExitCode code = ExitCode::done;  // or time_limit (a frame ended before its error target, or was not
                                     // begun) or interrupted
    std::int64_t count = 0;          // frames that are written, the first ones
    nlohmann::ordered_json report;
};

// Renders a frame range and writes each frame as it ends; every frame gets an equal share of the time that is
// left. An interrupted frame is not written, and none begins that has no time for a sample. Throws
// Error(interrupted) in the first one.
[[nodiscard]] RenderedFrames render_frames(const RenderCommand& command, RenderSession& session,
                                           const RenderJob& job);

}  // namespace voxilux
