#include "passes/aerial/aerial.h"

#include "passes/sky/sky.h"

namespace voxilux {

AerialPlanes record_aerial_trace(const RenderPlan& plan, const DispatchTile& tile, const Plane& first_hits,
                                 const Plane& weights, Recording& recording) {
    const AerialPlanes planes{.weights = {declare_plane<gpu::vec3>(plan, "aerial.weights", recording)},
                              .light = {declare_plane<gpu::vec3>(plan, "aerial.light", recording)}};
    recording.dispatch({.label = "aerial.trace",
                        .shader = "aerial_trace",
                        .extent = pixel_extent(plan, tile),
                        .bindings = {{"Frame", frame_buffer(recording)},
                                     {"Sky", sky_params_buffer(recording)},
                                     {"Scatter", scatter_buffer(plan, recording)},
                                     {"Hits", first_hits.buffer},
                                     {"Weights", weights.buffer},
                                     {"DimmedWeights", planes.weights.buffer},
                                     {"AerialLight", planes.light.buffer}},
                        .constants = {sequence_constant(plan),
                                      projection_constant(plan),
                                      {"traces_air", plan.traces_air() ? 1u : 0u},
                                      {"hits_stride", first_hits.stride},
                                      {"weights_stride", weights.stride}}});
    return planes;
}

}  // namespace voxilux
