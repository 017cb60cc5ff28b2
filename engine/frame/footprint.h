#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "frame/frame.h"
#include "plan/device_limits.h"
#include "plan/render_plan.h"

namespace voxilux {

struct PlannedPass {
    std::string label;
    std::uint64_t count = 0;  // dispatches in a frame, if no dispatch tile is made smaller

    bool operator==(const PlannedPass&) const = default;
};

struct PlannedBuffer {
    std::string buffer;
    std::uint64_t bytes = 0;
    bool persistent = false;  // its contents outlive a recording
    bool by_address = false;  // shaders reach it by its address, so that no binding limits it

    bool operator==(const PlannedBuffer&) const = default;
};

// What a frame of a plan runs and holds on the device, in the order of the recordings.
struct Footprint {
    std::vector<PlannedPass> passes;
    std::vector<PlannedBuffer> buffers;

    bool operator==(const Footprint&) const = default;

    [[nodiscard]] std::uint64_t total_bytes() const;
};

// Records one sample of a tile, as record_frame does.
using SampleRecorder = std::function<void(const RenderPlan&, const DispatchTile&, gpu::FrameParams,
                                          const SampleNumber&, Recording&)>;

// The footprint of the first frame, world and film included, from recordings that nobody executes: the upload
// of the scene, the first two samples of every tile, and the denoiser. All later samples record what the
// second does. For a frame range, it is the footprint of a frame that evicts occlusion cells, as later frames
// may.
[[nodiscard]] Footprint footprint(const RenderPlan& plan, const SampleRecorder& record = record_frame);

// plan_render within the limits of a device and the memory budget of the request. Throws
// Error(out_of_memory), which names the largest buffer, where one exceeds the limits or all together exceed
// the budget.
[[nodiscard]] RenderPlan plan_within_memory(const Scene& scene, const SceneFacts& facts,
                                            const WorldFacts& world, const PlanRequest& request,
                                            const DeviceLimits& limits);

// The plan and its footprint as text, stable between runs: what `voxilux plan` prints.
[[nodiscard]] std::string describe(const RenderPlan& plan);

}  // namespace voxilux
