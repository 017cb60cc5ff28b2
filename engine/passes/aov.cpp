#include "passes/aov.h"

#include "plan/film_planes.h"

namespace voxilux {

SurfacePlanes record_aov_surface(const RenderPlan& plan, const Slice& slice, const Plane& hits,
                                 Recording& recording) {
    const SurfacePlanes planes{{use_buffer(plan, "aov.albedo", recording)},
                               {use_buffer(plan, "aov.normal", recording)}};
    Dispatch dispatch{.label = "aov.surface",
                      .shader = "aov_surface",
                      .extent = pixel_extent(plan, slice),
                      .bindings = {{"Frame", use_buffer(plan, "frame", recording)},
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

void record_aov_position(const RenderPlan& plan, const Slice& slice, const Plane& hits,
                         Recording& recording) {
    recording.dispatch(
        {.label = "aov.position",
         .shader = "aov_position",
         .extent = pixel_extent(plan, slice),
         .bindings = {{"Frame", use_buffer(plan, "frame", recording)},
                      {"Hits", hits.buffer},
                      {"Position", use_buffer(plan, film_buffer("position", slice.band), recording)},
                      {"Depth", use_buffer(plan, film_buffer("depth", slice.band), recording)}},
         .constants = {{"hits_stride", hits.stride}}});
}

}  // namespace voxilux
