#pragma once

#include <cstdint>

#include "plan/render_plan.h"

namespace voxilux {

// What a render does with its image.
struct PictureUse {
    bool writes_exr = false;
    bool writes_png = false;
    bool keeps_film = false;         // for checkpoints
    bool writes_checkpoint = false;  // it takes long enough for one
    bool denoises = false;
};

struct RenderOptions;

// What a render with these options that takes this long does with its image.
[[nodiscard]] PictureUse picture_use(const RenderOptions& options, double seconds);

struct MemoryForecast {
    std::uint64_t device_bytes = 0;    // exact: the buffers of the plan
    std::uint64_t peak_rss_bytes = 0;  // of the process, up to the end of a render
};

// Peak of the host bytes that the end of a render takes in addition to what its samples need: the film as
// read back, the image, and the copies made to write it.
[[nodiscard]] std::uint64_t end_bytes(const RenderPlan& plan, const PictureUse& use);

// The memory of a render whose pilot has just run in this process: what is resident now plus end_bytes(), or
// the peak so far if that was more.
[[nodiscard]] MemoryForecast forecast_memory(const RenderPlan& plan, const PictureUse& use);

// Bytes of this process that are resident now, and the peak so far, from the system.
struct ResidentBytes {
    std::uint64_t now = 0;
    std::uint64_t peak = 0;
};
[[nodiscard]] ResidentBytes resident_bytes();

}  // namespace voxilux
