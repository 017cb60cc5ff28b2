#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "jobs/frame_list.h"
#include "render/progress_line.h"
#include "render/render.h"

namespace voxilux {

// What a command line asks of a session.
struct RenderJob {
    const std::vector<std::string>& outputs;
    FrameList frames;
    const RenderOptions& options;
    ProgressLine& progress;
    std::uint64_t scene_hash = 0;  // of the animated scene
};

// The names of a frame's pictures: the outputs, numbered in a frame range.
[[nodiscard]] std::vector<std::string> files_of_frame(const std::vector<std::string>& outputs,
                                                      const FrameList& frames, std::int64_t frame);

// Renders a frame range and writes each frame as it ends; every frame gets an equal share of the time that is
// left. An interrupted frame is not written. Returns done, time_limit (some frame ended before its error
// target) or interrupted.
[[nodiscard]] int render_frames(const RenderCommand& command, RenderSession& session, const RenderJob& job);

}  // namespace voxilux
