#pragma once

#include <cstdint>

#include "passes/plane.h"
#include "shared/gpu_types.h"

namespace voxilux {

// Openness of each hit: the share of cosine-weighted rays that meet nothing within the radius, by brute
// force.
[[nodiscard]] Plane record_ao_trace(const RenderPlan& plan, const Slice& slice, const Plane& hits,
                                    Recording& recording);

// One sample of the cells.
struct AoStep {
    gpu::AoParams params;
    bool sweeps = false;  // cells that nobody has seen for long are given up first
};

// The same, shared in the cells of a hash. The slice is the whole picture. Where no sample came before
// (`params.has_last` is 0) the table is emptied first.
[[nodiscard]] Plane record_ao_cells(const RenderPlan& plan, const Slice& slice, const Plane& hits,
                                    const AoStep& step, Recording& recording);

// Whether the table is swept in a frame; frames are counted from 0.
[[nodiscard]] bool is_sweep_frame(std::uint64_t frame);

}  // namespace voxilux
