#pragma once

#include <cstdint>

#include "plan/render_plan.h"

namespace voxilux {

// What a render does with its picture.
struct PictureUse {
    bool writes_exr = false;
    bool writes_png = false;
    bool keeps_film = false;         // for checkpoints
    bool writes_checkpoint = false;  // it is long enough for one
    bool denoises = false;
};

struct RenderOptions;

// What a render with these options does with its picture when it takes so many seconds.
[[nodiscard]] PictureUse picture_use(const RenderOptions& options, double seconds);

struct MemoryForecast {
    std::uint64_t device_bytes = 0;    // exact: the buffers of the plan
    std::uint64_t peak_rss_bytes = 0;  // of the process, to the end of a render
};

// Most bytes on the host that the end of a render takes beside what its samples need: the film as read back,
// the picture, and what writing it copies.
[[nodiscard]] std::uint64_t end_bytes(const RenderPlan& plan, const PictureUse& use);

// The memory of a render whose pilot ran in this process a moment ago: what is resident now and end_bytes(),
// or what was resident before, if that was more.
[[nodiscard]] MemoryForecast forecast_memory(const RenderPlan& plan, const PictureUse& use);

// Bytes of this process that are in memory now, and the most that ever were, from the system.
struct ResidentBytes {
    std::uint64_t now = 0;
    std::uint64_t peak = 0;
};
[[nodiscard]] ResidentBytes resident_bytes();

}  // namespace voxilux
