#pragma once

#include "passes/plane.h"
#include "shared/gpu_types.h"

namespace voxilux {

// Openness of each hit: the share of cosine-weighted rays that meet nothing within the radius, by brute
// force.
[[nodiscard]] Plane record_ao_trace(const RenderPlan& plan, const Slice& slice, const Plane& hits,
                                    Recording& recording);

// The same, shared in the cells of a hash. The slice is the whole picture. When `params.has_last` is 0 the
// table is emptied first; when `params.swept_count` is not 0, cells that nobody has seen for long are given
// up.
[[nodiscard]] Plane record_ao_cells(const RenderPlan& plan, const Slice& slice, const Plane& hits,
                                    const gpu::AoParams& params, Recording& recording);

// Slots of the table that one frame sweeps: each has its turn once in kSweepFrames frames.
[[nodiscard]] std::uint32_t swept_slots(const RenderPlan& plan);

}  // namespace voxilux
