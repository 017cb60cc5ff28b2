#include "passes/film/aov.h"

#include "plan/film_planes.h"

namespace voxilux {

void record_aov_position(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                         Recording& recording) {
    recording.dispatch(
        {.label = "aov.position",
         .shader = "aov_position",
         .extent = pixel_extent(plan, tile),
         .bindings = {{"Frame", frame_buffer(recording)},
                      {"Hits", hits.buffer},
                      {"Position", film_plane<float>(plan, {"position", 3}, tile.film_tile, recording)},
                      {"Depth", film_plane<float>(plan, {"depth", 1}, tile.film_tile, recording)}},
         .constants = {{"hits_stride", hits.stride}, projection_constant(plan)}});
}

}  // namespace voxilux
