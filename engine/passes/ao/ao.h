#pragma once

#include <cstdint>

#include "passes/plane.h"
#include "shared/gpu_types.h"

namespace voxilux {

// Ambient visibility of each hit: the fraction of cosine-distributed rays that meet nothing within the
// radius, traced for each pixel alone.
[[nodiscard]] Plane record_ao_trace(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                                    Recording& recording);

// One sample of the cells.
struct AoStep {
    gpu::AoParams params;
    bool sweeps = false;  // cells that have not been seen for long are released first
};

// The same from cells shared in a hash table. The tile is the whole crop window. The table is emptied first
// when no sample came before (`params.has_last` is 0).
[[nodiscard]] Plane record_ao_cells(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                                    const AoStep& step, Recording& recording);

// The ambient visibility by the technique of the plan; only cells read `step`.
[[nodiscard]] Plane record_ao(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                              const AoStep& step, Recording& recording);

// Buffers of the cells as a sample left them: the slot of each pixel, and the samples of each slot. Samples
// are counted from 0 since the table was empty.
struct SeenCells {
    std::string slots;
    std::string samples;
};
[[nodiscard]] SeenCells seen_cells(const RenderPlan& plan, std::uint64_t sample, Recording& recording);

// How many frames a cell may stay unseen: kCellMaxAge while the live cells fill up to a quarter of the table,
// then less in proportion to it, but not below kCellMinAge.
[[nodiscard]] std::uint32_t cell_age(const RenderPlan& plan, std::uint64_t live_cells);

// Whether the table is swept in a frame, counted from 0: never while cells fill at most an eighth of it, then
// in one frame of eight, and in every frame while cells may stay unseen for less than kCellMaxAge.
[[nodiscard]] bool is_sweep_frame(const RenderPlan& plan, std::uint64_t frame, std::uint64_t live_cells);

}  // namespace voxilux
