#pragma once

// The rays that the benchmarks march.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "jobs/bench/bench_scene.h"
#include "shared/gpu_types.h"
#include "world/march_world.h"

namespace voxilux {

// primary: one ray through each pixel. ao: one cosine-distributed ray, 32 voxels long, from each surface that
// those hit. unbounded: the same without a limit.
enum class RayKind : std::uint8_t { primary, ao, unbounded };
inline constexpr std::array kRayKinds = {RayKind::primary, RayKind::ao, RayKind::unbounded};

// "primary", "ao", "long".
[[nodiscard]] std::string_view name_of(RayKind kind);

// The kind of that name; Error(usage) with the known names when there is none.
[[nodiscard]] RayKind ray_kind_named(std::string_view name);

// What the camera rays of a picture of `size` pixels and the beams around their tiles are made from.
[[nodiscard]] gpu::FrameParams bench_frame(const BenchScene& scene, glm::ivec2 size, std::uint32_t seed);

// The rays of a kind through an image of `size` pixels, local to the world, in the order in which a render
// marches them: tiles of 8 x 8 pixels, 64 in a row, with rows of tiles dealt alternately to the two halves of
// the list. Pixels without such a ray are left out. `guide` is any structure of the scene's world.
[[nodiscard]] std::vector<gpu::Ray> bench_rays(const BenchScene& scene, const MarchWorld& guide, RayKind kind,
                                               glm::ivec2 size, std::uint32_t seed);

}  // namespace voxilux
