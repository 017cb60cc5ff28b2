#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "passes/world.h"
#include "plan/film_planes.h"
#include "plan/render_plan.h"
#include "record/recording.h"
#include "shared/gpu_types.h"

namespace voxilux {

// A per-pixel quantity of the current tile. An effect that is off yields a constant: one value read with
// stride 0, so that its readers need no variant.
struct Plane {
    std::string buffer;
    std::uint32_t stride = 1;
};

// Elements of a plane of this many pixels, rounded up to whole groups.
constexpr std::uint64_t plane_elements(std::uint64_t pixels) {
    return (pixels + gpu::kGroupPixels - 1) / gpu::kGroupPixels * gpu::kGroupPixels;
}

// Declares a plane of the current tile: one element per pixel. Its size is that of the largest tile.
template <class T>
std::string declare_plane(const RenderPlan& plan, std::string name, Recording& recording,
                          Lifetime lifetime = Lifetime::transient) {
    // A tile that is not the first of its film tile may begin within a group.
    const std::uint64_t before = plan.tile_rows < plan.film_tile_rows ? gpu::kGroupPixels - 1 : 0;
    return declare<T>(recording, std::move(name), plane_elements(before + plan.tile_pixels()), lifetime);
}

// A plane of the film in a film tile: sums, or the positions and depths of one sample.
template <class T>
std::string film_plane(const RenderPlan& plan, const FilmPlane& plane, std::uint32_t film_tile,
                       Recording& recording) {
    return declare<T>(recording, film_buffer(plane.name, film_tile),
                      plane_elements(plan.film_tile_pixels()) * plane.components, Lifetime::persistent);
}

// The parameters of the tile.
[[nodiscard]] std::string frame_buffer(Recording& recording);
[[nodiscard]] std::string counters_buffer(Recording& recording);

// A constant hit that is a miss, for a frame that marches no world.
[[nodiscard]] Plane constant_miss(Recording& recording);

// A constant texel of equal floats, for planes of floats and of vectors.
[[nodiscard]] Plane constant_value(float value, Recording& recording);

// The consecutive rows of the image that a recording renders.
struct DispatchTile {
    std::uint32_t film_tile = 0;
    std::uint32_t film_tile_first_row = 0;  // row of the image
    std::uint32_t first_row = 0;
    std::uint32_t row_count = 0;
};

// Invocations of a pass over the pixels of a tile.
[[nodiscard]] Extent pixel_extent(const RenderPlan& plan, const DispatchTile& tile);

// The world's arrays, or a placeholder that no shader reads when the plan has no voxels. The scratch buffers
// of the distance-field build are not among them.
[[nodiscard]] WorldBuffers world_buffers(const RenderPlan& plan, Recording& recording);

// The kSequence* id (shared/sequence.h).
[[nodiscard]] gpu::uint sequence_id(Sequence sequence);
// Constant of every pass that draws from the sample sequence (shaders/lib/samples.glsl).
[[nodiscard]] Constant sequence_constant(const RenderPlan& plan);
// Constant of every pass that makes camera rays.
[[nodiscard]] Constant projection_constant(const RenderPlan& plan);

// Constants of every pass that reads surfaces (shaders/lib/surface.glsl).
[[nodiscard]] std::vector<Constant> surface_constants(const RenderPlan& plan);
// The subset of these constants that selects how spheres are found.
[[nodiscard]] std::vector<Constant> sphere_constants(const RenderPlan& plan);

// Parameters of an atmosphere, for scenes without one.
[[nodiscard]] std::string constant_sky_buffer(Recording& recording);

// A small buffer that no shader reads, for blocks that a shader variant does not use.
[[nodiscard]] std::string placeholder_buffer(Recording& recording);

// The materials and the spheres, or the placeholder when the plan has none.
[[nodiscard]] std::string materials_buffer(const RenderPlan& plan, Recording& recording);
[[nodiscard]] std::string spheres_buffer(const RenderPlan& plan, Recording& recording);
// The spheres as the uniform block SphereTable.
[[nodiscard]] std::string sphere_table_buffer(const RenderPlan& plan, Recording& recording);
// The hierarchy over many spheres, or the placeholder when they are few.
[[nodiscard]] std::string sphere_tree_buffer(const RenderPlan& plan, Recording& recording);

// The gains of rough surfaces, or the placeholder where the plan shows none.
[[nodiscard]] std::string gains_buffer(const RenderPlan& plan, Recording& recording);

// The lights, and the table from which one is drawn in proportion to its power.
[[nodiscard]] std::string lights_buffer(const RenderPlan& plan, Recording& recording);
[[nodiscard]] std::string light_table_buffer(const RenderPlan& plan, Recording& recording);

// A pass that reads hits and writes one float for each.
struct SurfacePass {
    std::string label;
    std::string shader;
    std::string output_block;
    std::string output_buffer;
    std::vector<Constant> constants;  // in addition to surface_constants()
};

[[nodiscard]] Plane record_surface_pass(const RenderPlan& plan, const DispatchTile& tile,
                                        const SurfacePass& pass, const Plane& hits, Recording& recording);

}  // namespace voxilux
