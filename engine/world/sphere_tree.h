#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/scene.h"
#include "shared/gpu_types.h"

namespace voxilux {

// The spheres in sphere_order(), local to `origin`.
[[nodiscard]] std::vector<gpu::SphereRecord> sphere_records(const Scene& scene, glm::ivec3 origin);

// The hierarchy over spheres that rays walk where there are more than gpu::kFewSpheres
// (shared/sphere_tree.h): 2 n - 1 nodes for n spheres, none for none.
[[nodiscard]] std::vector<gpu::SphereNode> build_sphere_tree(std::span<const gpu::SphereRecord> spheres);

// Mean number of nodes that a ray visits when it crosses the whole hierarchy and nothing stops it: the
// probability to meet a box is in proportion to its surface (Goldsmith and Salmon 1987).
[[nodiscard]] double mean_visits(std::span<const gpu::SphereNode> nodes);

}  // namespace voxilux
