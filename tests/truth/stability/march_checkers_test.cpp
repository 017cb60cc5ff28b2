// The checkers of the march: each accepts the truth and rejects a perturbed one.

#include <gtest/gtest.h>

#include <algorithm>

#include "support/exact_walk.h"
#include "support/interval_walk.h"
#include "truth/stability/march_checkers.h"

namespace voxilux {
namespace {

TEST(MarchChecker, notices_a_structure_of_another_world_among_equal_ones) {
    const VoxelWorld& world = test::world_named("random_0.02");
    VoxelWorld other = world;
    other.set({24, 16, 8}, 3);
    const std::vector<gpu::Ray> rays = test::family_named("random", world.size(), 20000);
    std::vector<gpu::MarchProbe> agreed;
    std::vector<MarchWorld> structures = test::all_structures(world);
    ASSERT_EQ(test::march_differences(structures, rays, agreed), "");
    ASSERT_EQ(agreed.size(), rays.size());
    structures.back() = build_march_world(other, structures.back().traversal);
    const std::string found = test::march_differences(structures, rays, agreed);
    EXPECT_NE(found.find(name_of(structures.back().traversal)), std::string::npos) << found;
}

TEST(MarchChecker, notices_a_change_in_any_part_of_a_hit) {
    const VoxelWorld& world = test::world_named("random_0.3");
    gpu::MarchHit hit{};
    for (const gpu::Ray& ray : test::family_named("random", world.size(), 100)) {
        hit = test::walk_cells(world, ray);
        if (hit.face < gpu::kFaceInside) break;
    }
    ASSERT_LT(hit.face, gpu::kFaceInside);
    std::vector<gpu::MarchHit> changed(6, hit);
    changed[0].cell.y += 1;
    changed[1].face ^= 1u;
    changed[2].t = std::nextafter(hit.t, 100.0f);
    changed[3].material += 1;
    changed[4].crossed.z += 1;
    changed[5].face = gpu::kFaceMiss;
    EXPECT_EQ(test::difference(hit, hit), "");
    for (const gpu::MarchHit& other : changed)
        EXPECT_NE(test::difference(other, hit), "");
}

TEST(IntervalWalk, has_one_answer_for_nearly_every_ray_and_rejects_all_others) {
    const VoxelWorld& world = test::world_named("random_0.02");
    int certain = 0;
    int hits = 0;
    const std::vector<gpu::Ray> rays = test::family_named("random", world.size(), 20000);
    for (const gpu::Ray& ray : rays) {
        const std::vector<test::PossibleHit> possible = test::interval_walk(world, ray);
        gpu::MarchHit hit = test::walk_cells(world, ray);
        ASSERT_EQ(test::disagreement(possible, hit), "") << test::print(ray);
        certain += possible.size() == 1 ? 1 : 0;
        if (hit.face >= gpu::kFaceInside || possible.size() > 1) continue;
        ++hits;
        gpu::MarchHit late = hit;
        late.t *= 1.0f + 8.0f * 0x1p-23f;
        gpu::MarchHit moved = hit;
        moved.cell.x += 1;
        gpu::MarchHit turned = hit;
        turned.face = (hit.face + 2) % 6;
        gpu::MarchHit missed = hit;
        missed.face = gpu::kFaceMiss;
        for (const gpu::MarchHit& wrong : {late, moved, turned, missed})
            ASSERT_NE(test::disagreement(possible, wrong), "") << test::print(ray);
    }
    EXPECT_GT(certain, static_cast<int>(rays.size()) * 999 / 1000);
    EXPECT_GT(hits, 1000);
}

// Ties that floats keep have one answer: that of the walk in exact integers.
TEST(IntervalWalk, agrees_with_exact_integers_on_ties) {
    for (const std::string name : {"random_0.02", "checkerboard", "corner_wall"}) {
        const VoxelWorld& world = test::world_named(name);
        for (const std::string family : {"corners", "diagonal_from_centre"}) {
            for (const gpu::Ray& ray : test::family_named(family, world.size(), 2000)) {
                const std::vector<test::PossibleHit> possible = test::interval_walk(world, ray);
                const test::ExactHit want = test::exact_walk(world, ray);
                ASSERT_EQ(possible.size(), 1u) << test::print(ray);
                ASSERT_EQ(possible[0].face, want.face) << test::print(ray);
                if (want.face == gpu::kFaceMiss) continue;
                ASSERT_EQ(possible[0].cell, want.cell) << test::print(ray);
            }
        }
    }
}

// Two planes within rounding of each other: both orders are possible, and the march's is one of them.
TEST(IntervalWalk, follows_both_ways_past_a_corner_that_floats_cannot_tell) {
    VoxelWorld world(glm::ivec3(0), glm::ivec3(1));
    world.set({5, 4, 4}, 1);
    world.set({4, 5, 4}, 2);
    gpu::Ray ray{{2, 2, 4}, {0.0f, 0.0f, 0.5f}, {1.0f, 1.0f, 0.0f}, gpu::kUnbounded};
    ray.direction.y = std::nextafter(1.0f, 0.0f);
    const std::vector<test::PossibleHit> possible = test::interval_walk(world, ray);
    for (const glm::ivec3 cell : {glm::ivec3(5, 4, 4), glm::ivec3(4, 5, 4)})
        EXPECT_TRUE(
            std::ranges::any_of(possible, [&](const test::PossibleHit& hit) { return hit.cell == cell; }));
    EXPECT_EQ(test::disagreement(possible, test::walk_cells(world, ray)), "");
}

}  // namespace
}  // namespace voxilux
