#pragma once

#include <string>

#include "plan/render_plan.h"
#include "record/recording.h"

namespace voxilux {

// How many samples the rows of a film have.
struct SampleCounts {
    std::uint32_t samples = 0;      // of all rows
    std::uint32_t rows_ahead = 0;   // rows from the top that have one more
    std::uint32_t rows_behind = 0;  // rows from the top that have one less
};

// An image on the device: [height][width] linear radiance, three floats.
struct DisplayBuffer {
    std::string buffer;
    glm::ivec2 size{0};  // pixels
};

// Means of the film for whoever presents it on the device; pixels with no sample are black. It is recorded
// where a display is asked for, and is no part of a frame.
DisplayBuffer record_display_resolve(const RenderPlan& plan, const SampleCounts& counts,
                                     Recording& recording);

}  // namespace voxilux
