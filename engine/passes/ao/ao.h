#pragma once

#include <cstdint>

#include "passes/plane.h"
#include "shared/gpu_types.h"

namespace voxilux {

// Visibility of each hit: the share of cosine-weighted rays that meet nothing within the radius, by brute
// force.
[[nodiscard]] Plane record_ao_trace(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                                    Recording& recording);

// One sample of the cells.
struct AoStep {
    gpu::AoParams params;
    bool sweeps = false;  // cells that nobody has seen for long are given up first
};

// The same, shared in the cells of a hash. The tile is the whole picture. Where no sample came before
// (`params.has_last` is 0) the table is emptied first.
[[nodiscard]] Plane record_ao_cells(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                                    const AoStep& step, Recording& recording);

// The visibility by the technique of the plan; `step` is of cells alone.
[[nodiscard]] Plane record_ao(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                              const AoStep& step, Recording& recording);

// Buffers of the cells as a sample left them, counted from 0 since the table was empty: the slot of each
// pixel, and the samples of each slot.
struct SeenCells {
    std::string slots;
    std::string samples;
};
[[nodiscard]] SeenCells seen_cells(const RenderPlan& plan, std::uint64_t sample, Recording& recording);

// How long cells stay unseen, frames, when so many are in the table: kCellMaxAge while they take up to a
// quarter of it, then in proportion less, but not below kCellMinAge.
[[nodiscard]] std::uint32_t cell_age(const RenderPlan& plan, std::uint64_t live_cells);

// Whether the table is swept in a frame, counted from 0: never while an eighth of it holds all cells, then in
// one frame of eight, and in each while cells stay less than kCellMaxAge.
[[nodiscard]] bool is_sweep_frame(const RenderPlan& plan, std::uint64_t frame, std::uint64_t live_cells);

}  // namespace voxilux
