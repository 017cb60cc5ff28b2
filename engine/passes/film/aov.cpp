#include "passes/film/aov.h"

#include "plan/film_planes.h"

namespace voxilux {

SurfacePlanes record_aov_surface(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                                 Recording& recording) {
    const SurfacePlanes planes{{declare_plane<gpu::vec3>(plan, "aov.albedo", recording)},
                               {declare_plane<gpu::vec3>(plan, "aov.normal", recording)}};
    Dispatch dispatch{.label = "aov.surface",
                      .shader = "aov_surface",
                      .extent = pixel_extent(plan, tile),
                      .bindings = {{"Frame", frame_buffer(recording)},
                                   {"Hits", hits.buffer},
                                   {"Materials", materials_buffer(plan, recording)},
                                   {"Spheres", spheres_buffer(plan, recording)},
                                   {"Albedo", planes.albedo.buffer},
                                   {"Normal", planes.normal.buffer}},
                      .constants = surface_constants(plan)};
    dispatch.constants.push_back({"hits_stride", hits.stride});
    recording.dispatch(std::move(dispatch));
    return planes;
}

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
         .constants = {{"hits_stride", hits.stride}}});
}

}  // namespace voxilux
