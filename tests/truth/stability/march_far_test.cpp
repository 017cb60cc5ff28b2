// Worlds that are large, sparse or far away.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "shared/hash.h"
#include "support/march_oracle.h"
#include "truth/stability/march_checkers.h"

namespace voxilux {
namespace {

// Voxels. Times of up to 7100 voxels round at 2^-24 a few times, 2^-9 in all.
constexpr double kFarMargin = 4e-3;
// Most bytes of one array that these tests build.
constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 27;

// The traversals whose grid of roots fits into one array over a world of `chunks` chunks.
std::vector<Traversal> traversals_that_hold(glm::ivec3 chunks) {
    std::vector<Traversal> fitting;
    for (const Traversal traversal : all_traversals()) {
        const int log2 = gpu::root_log2(static_cast<gpu::uint>(traversal));
        const auto roots = glm::u64vec3(chunks) << std::uint64_t(gpu::kChunkLog2 - log2);
        if (roots.x * roots.y * roots.z * 4 <= kMaxBytes) fitting.push_back(traversal);
    }
    return fitting;
}

// A ball of voxels with holes.
void add_cluster(VoxelWorld& world, glm::ivec3 centre) {
    constexpr int kRadius = 3;
    for (int i = 0; i < 343; ++i) {
        const glm::ivec3 d = glm::ivec3(i % 7, i / 7 % 7, i / 49) - kRadius;
        const glm::ivec3 cell = centre + d;
        if (d.x * d.x + d.y * d.y + d.z * d.z > kRadius * kRadius || !world.contains(cell)) continue;
        if (gpu::pcg_hash(static_cast<std::uint32_t>(i)) % 4 != 0)
            world.set(cell, static_cast<std::uint16_t>(i % 251));
    }
}

// Clusters in the corners and the centre.
VoxelWorld sparse_world(glm::ivec3 chunks) {
    VoxelWorld world(glm::ivec3(0), chunks);
    const glm::ivec3 last = world.size() - 1;
    for (int corner = 0; corner < 8; ++corner)
        add_cluster(world, last * glm::ivec3(corner & 1, (corner >> 1) & 1, corner >> 2));
    add_cluster(world, world.size() / 2);
    return world;
}

// Rays from anywhere, inside and out, to points in and beside the clusters, and axial ones through them.
std::vector<gpu::Ray> rays_to_clusters(const std::vector<glm::ivec3>& solids, glm::ivec3 size, int count) {
    std::vector<gpu::Ray> rays = test::family_named("random", size, count);
    std::mt19937 dice(test::kMarchSeed);
    for (gpu::Ray& ray : rays) {
        const glm::ivec3 near(glm::uvec3(dice(), dice(), dice()) % 5u);
        const glm::ivec3 target = solids[dice() % solids.size()] + near - 2;
        const glm::dvec3 way = glm::dvec3(target - ray.cell) + 0.25 - glm::dvec3(ray.fraction);
        ray.direction = glm::vec3(glm::normalize(way));
        if (dice() % 8 == 0) {
            const auto axis = static_cast<int>(dice() % 3);
            const int from = ray.cell[axis];
            ray.cell = target;
            ray.cell[axis] = from;
            ray.direction = glm::vec3(0.0f);
            ray.direction[axis] = from < target[axis] ? 1.0f : -1.0f;
        }
        if (dice() % 4 == 0) ray.cell -= glm::ivec3(glm::floor(ray.direction * 1e6f));
    }
    return rays;
}

void expect_true_hits(glm::ivec3 chunks, int count) {
    const VoxelWorld world = sparse_world(chunks);
    const std::vector<glm::ivec3> solids = test::solid_cells(world);
    const std::vector<gpu::Ray> rays = rays_to_clusters(solids, world.size(), count);
    std::vector<gpu::MarchProbe> got;
    std::vector<gpu::MarchProbe> first;
    for (const Traversal traversal : traversals_that_hold(chunks)) {
        ASSERT_EQ(test::march_differences({build_march_world(world, traversal)}, rays, got), "");
        if (first.empty()) first = got;
        ASSERT_EQ(std::memcmp(got.data(), first.data(), got.size() * sizeof got[0]), 0) << name_of(traversal);
    }
    int hits = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const gpu::Ray& entry = first[i].entry;
        ASSERT_EQ(test::difference(first[i].hit, test::walk_cells(world, entry)), "") << test::print(rays[i]);
        const test::OracleBounds bounds = test::oracle_bounds(solids, entry, kFarMargin);
        ASSERT_EQ(test::disagreement(bounds, entry, first[i].hit, kFarMargin), "") << test::print(rays[i]);
        hits += first[i].hit.face != gpu::kFaceMiss ? 1 : 0;
    }
    EXPECT_GT(hits, count / 4);
}

TEST(FarWorld, worlds_4096_voxels_long_are_hit_as_boxes_are) {
    for (const glm::ivec3 chunks : {glm::ivec3(256, 1, 1), {1, 256, 1}, {1, 1, 256}, {256, 16, 1}})
        expect_true_hits(chunks, 500);
}

TEST(FarWorldNightly, a_sparse_world_of_4096_cubed_is_hit_as_boxes_are) {
    EXPECT_GE(traversals_that_hold(glm::ivec3(256)).size(), 1u);
    expect_true_hits(glm::ivec3(256), 20000);
}

TEST(FarWorldNightly, sparse_worlds_of_1024_cubed_are_hit_as_boxes_are) {
    EXPECT_GE(traversals_that_hold(glm::ivec3(64)).size(), 2u);
    expect_true_hits(glm::ivec3(64), 20000);
}

}  // namespace
}  // namespace voxilux
