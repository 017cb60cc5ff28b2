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
    std::uint64_t count = 0;  // dispatches in a frame, when no tile is cut smaller

    bool operator==(const PlannedPass&) const = default;
};

struct PlannedBuffer {
    std::string buffer;
    std::uint64_t bytes = 0;
    bool persistent = false;  // its contents outlive a recording
    bool by_address = false;  // shaders reach it by its address where it is too large to be bound

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
// of the scene, the first two samples of every tile, and the denoiser. All samples after the first record
// what the second does. Of a frame range a frame is meant that gives up occlusion cells, as later ones may.
[[nodiscard]] Footprint footprint(const RenderPlan& plan, const SampleRecorder& record = record_frame);

// plan_render, for a device and a budget: throws Error(out_of_memory) when a buffer would pass the device's
// limits or all together the budget, naming the largest.
[[nodiscard]] RenderPlan plan_within_memory(const Scene& scene, const SceneFacts& facts,
                                            const WorldFacts& world, const PlanRequest& request,
                                            const DeviceLimits& limits);

// The plan and its footprint as text, stable between runs: what `voxilux plan` prints.
[[nodiscard]] std::string describe(const RenderPlan& plan);

}  // namespace voxilux
