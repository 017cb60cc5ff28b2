#include "passes/primary/primary.h"

#include "shared/gpu_types.h"

namespace voxilux {

std::string record_primary_beam(const RenderPlan& plan, const DispatchTile& tile, Recording& recording) {
    const std::string starts = declare<float>(recording, "primary.starts", plan.tile_beams());
    const gpu::uint columns = gpu::beam_count(static_cast<gpu::uint>(plan.settings.size.x));
    Dispatch dispatch{.label = "primary.beam",
                      .shader = "primary_beam",
                      .extent = {columns * gpu::beam_count(tile.row_count), 1, 1},
                      .bindings = {{"Frame", frame_buffer(recording)}, {"Starts", starts}},
                      .constants = {projection_constant(plan)}};
    point_to_world(plan.world.traversal, world_buffers(plan, recording), dispatch);
    recording.dispatch(std::move(dispatch));
    return starts;
}

Plane record_primary_march(const RenderPlan& plan, const DispatchTile& tile, const std::string& starts,
                           Recording& recording) {
    const Plane hits{declare_plane<gpu::Hit>(plan, "primary.hits", recording)};
    Dispatch dispatch{.label = "primary.march",
                      .shader = "primary_march",
                      .extent = pixel_extent(plan, tile),
                      .bindings = {{"Frame", frame_buffer(recording)},
                                   {"Counters", counters_buffer(recording)},
                                   {"Starts", starts},
                                   {"Hits", hits.buffer}},
                      .constants = {sequence_constant(plan), projection_constant(plan)}};
    point_to_world(plan.world.traversal, world_buffers(plan, recording), dispatch);
    recording.dispatch(std::move(dispatch));
    return hits;
}

}  // namespace voxilux
