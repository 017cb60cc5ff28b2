#include "passes/film/shade.h"

namespace voxilux {

Plane record_shade_resolve(const RenderPlan& plan, const DispatchTile& tile, const ShadeInputs& inputs,
                           Recording& recording) {
    const Plane color{declare_plane<gpu::vec3>(plan, "shade.color", recording)};
    recording.dispatch({.label = "shade.resolve",
                        .shader = "shade_resolve",
                        .extent = pixel_extent(plan, tile),
                        .bindings = {{"Frame", frame_buffer(recording)},
                                     {"Counters", tally_buffer(recording)},
                                     {"Hits", inputs.hits.buffer},
                                     {"Materials", materials_buffer(plan, recording)},
                                     {"Ao", inputs.ao.buffer},
                                     {"SkyLight", inputs.sky.buffer},
                                     {"Sun", inputs.sun.buffer},
                                     {"Direct", inputs.direct.buffer},
                                     {"Photons", inputs.photons.buffer},
                                     {"Weights", inputs.weights.buffer},
                                     {"Color", color.buffer}},
                        .constants = {{"hits_stride", inputs.hits.stride},
                                      {"ao_stride", inputs.ao.stride},
                                      {"sky_stride", inputs.sky.stride},
                                      {"sun_stride", inputs.sun.stride},
                                      {"direct_stride", inputs.direct.stride},
                                      {"photons_stride", inputs.photons.stride},
                                      {"weights_stride", inputs.weights.stride}}});
    return color;
}

}  // namespace voxilux
