#include "stability/march_judges.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/exact_walk.h"
#include "support/march_oracle.h"

namespace voxilux::test {

const VoxelWorld& world_named(const std::string& name) {
    static const std::vector<NamedWorld> worlds = small_worlds(kMarchSeed);
    return std::ranges::find(worlds, name, &NamedWorld::name)->world;
}

std::vector<gpu::Ray> family_named(const std::string& name, glm::ivec3 size, int count) {
    const std::vector<RayFamily> families = ray_families(size, count, kMarchSeed);
    return std::ranges::find(families, name, &RayFamily::name)->rays;
}

std::vector<gpu::Ray> all_families(glm::ivec3 size, int count) {
    std::vector<gpu::Ray> rays;
    for (const RayFamily& family : ray_families(size, count, kMarchSeed))
        rays.insert(rays.end(), family.rays.begin(), family.rays.end());
    return rays;
}

namespace {

// The path of an axial ray does not depend on where in its cell it starts.
gpu::Ray centred_if_axial(gpu::Ray ray) {
    const glm::vec3 d = ray.direction;
    if ((d.x != 0.0f) + (d.y != 0.0f) + (d.z != 0.0f) == 1) ray.fraction = glm::vec3(0.5f);
    return ray;
}

}  // namespace

void expect_exact_walk(const VoxelWorld& world, const std::vector<gpu::Ray>& rays) {
    const auto got = march_on_device(build_march_world(world), rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const ExactHit want = exact_walk(world, centred_if_axial(rays[i]));
        ASSERT_EQ(got[i].hit.face, want.face) << print(rays[i]);
        if (want.face == gpu::kFaceMiss) continue;
        ASSERT_EQ(got[i].hit.cell, want.cell) << print(rays[i]);
    }
}

void expect_plain_walk(const VoxelWorld& world, const std::vector<gpu::Ray>& rays) {
    const MarchWorld march_world = build_march_world(world);
    const auto got = march_on_device(march_world, rays);
    const glm::ivec3 size = march_world.size();
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const gpu::MarchHit want = walk_cells(world, rays[i]);
        ASSERT_EQ(got[i].hit.face, want.face) << print(rays[i]);
        ASSERT_LE(got[i].hit.steps, gpu::uint(size.x + size.y + size.z + 3)) << print(rays[i]);
        if (want.face == gpu::kFaceMiss) continue;
        ASSERT_EQ(got[i].hit.cell, want.cell) << print(rays[i]);
        ASSERT_EQ(got[i].hit.t, want.t) << print(rays[i]);
    }
}

void expect_boxes(const VoxelWorld& world, const std::vector<gpu::Ray>& rays) {
    const std::vector<glm::ivec3> solids = solid_cells(world);
    const auto got = march_on_device(build_march_world(world), rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const OracleBounds bounds = oracle_bounds(solids, rays[i], kMarchMargin);
        ASSERT_EQ(disagreement(bounds, rays[i], got[i].hit, kMarchMargin), "") << print(rays[i]);
    }
}

}  // namespace voxilux::test
