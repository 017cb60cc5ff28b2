#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/scene.h"
#include "shared/gpu_types.h"
#include "world/sphere_halves.h"

namespace voxilux {

// The spheres in sphere_order(), local to `origin`.
[[nodiscard]] std::vector<gpu::SphereRecord> sphere_records(const Scene& scene, glm::ivec3 origin);

// The hierarchy over spheres that rays walk where there are more than gpu::kFewSpheres
// (shared/sphere_tree.h), none for none. Throws Error(out_of_memory) where it would have more than
// gpu::kMaxTreeNodes nodes.
[[nodiscard]] std::vector<gpu::SphereNode> build_sphere_tree(std::span<const gpu::SphereRecord> spheres);

// The same by one way to cut, and the most nodes above a sphere.
[[nodiscard]] std::vector<gpu::SphereNode> build_sphere_tree(std::span<const gpu::SphereRecord> spheres,
                                                             SphereCut cut);
[[nodiscard]] std::uint32_t depth_of(std::span<const gpu::SphereNode> nodes);

// Mean number of nodes that a ray visits when it crosses the whole hierarchy and nothing stops it: the
// probability to meet a box is in proportion to its surface (Goldsmith and Salmon 1987).
[[nodiscard]] double mean_visits(std::span<const gpu::SphereNode> nodes);

}  // namespace voxilux
