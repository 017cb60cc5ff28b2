#pragma once

// What a camera ray must hit, found by testing every voxel as a box in double precision.

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "shared/gpu_types.h"

namespace voxilux::test {

// A ray in local coordinates; the direction need not be unit.
struct DoubleRay {
    glm::dvec3 origin;
    glm::dvec3 direction;
};

[[nodiscard]] DoubleRay to_double(const gpu::Ray& ray);

// Empty when the hit is right up to `margin` voxels, else what is wrong: the cell must be one that is hit
// first, the face must look towards the ray, the point must lie on face and ray, and t must lead there within
// `t_margin`.
[[nodiscard]] std::string hit_disagreement(const std::vector<glm::ivec3>& solids, const DoubleRay& ray,
                                           const gpu::Hit& hit, double margin, double t_margin);

}  // namespace voxilux::test
