#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/march_oracle.h"
#include "support/ray_families.h"
#include "support/traversal_name.h"
#include "world/march_world.h"

namespace voxilux {
namespace {

constexpr std::uint32_t kMarchSeed = 20261;
// Voxels. Rounding moves a crossing by at most 2^-23 of the path, 60 voxels here; the margin is far above it.
constexpr double kMargin = 1e-3;

std::string print_ray(const gpu::Ray& ray) {
    return fmt::format("cell ({}, {}, {}) fraction ({}, {}, {}) direction ({}, {}, {}) t_max {}", ray.cell.x,
                       ray.cell.y, ray.cell.z, ray.fraction.x, ray.fraction.y, ray.fraction.z,
                       ray.direction.x, ray.direction.y, ray.direction.z, ray.t_max);
}

std::vector<gpu::Ray> random_rays(glm::ivec3 size, int count) {
    return std::move(test::ray_families(size, count, kMarchSeed).front().rays);
}

class EveryTraversal : public ::testing::TestWithParam<Traversal> {};

TEST_P(EveryTraversal, visits_the_cells_of_the_plain_walk_in_every_family_and_world) {
    for (const test::NamedWorld& named : test::small_worlds(kMarchSeed)) {
        const MarchWorld march_world = build_march_world(named.world, GetParam());
        for (const test::RayFamily& family : test::ray_families(march_world.size(), 1500, kMarchSeed)) {
            for (const gpu::Ray& ray : family.rays) {
                const gpu::MarchHit hit = gpu::march(march_world, ray, march_world.chunks_size);
                const gpu::MarchHit expected = test::walk_cells(named.world, ray);
                ASSERT_EQ(hit.face, expected.face)
                    << named.name << " " << family.name << " " << print_ray(ray);
                ASSERT_EQ(hit.fault, gpu::kMarchFine);
                if (hit.face == gpu::kFaceMiss) continue;
                ASSERT_EQ(hit.cell, expected.cell)
                    << named.name << " " << family.name << " " << print_ray(ray);
                ASSERT_EQ(hit.t, expected.t) << named.name << " " << family.name << " " << print_ray(ray);
                ASSERT_EQ(hit.material, expected.material);
                ASSERT_LE(hit.steps, expected.steps);
            }
        }
    }
}

// Longer than 2^16 chunks: places of blocks must not be cut to 16 bits.
TEST(March, world_of_a_million_voxels_on_one_axis_is_hit_at_both_ends) {
    VoxelWorld world(glm::ivec3(0), glm::ivec3(66000, 1, 1));
    for (int chunk = 0; chunk < 66000; chunk += 97)
        world.set({16 * chunk + 7, 5, 5}, 1);
    for (const Traversal traversal : {Traversal::deep, Traversal::wide}) {
        const MarchWorld march_world = build_march_world(world, traversal);
        for (int chunk = 97; chunk < 66000; chunk += 97) {
            const gpu::Ray ray{
                {16 * (chunk - 50), 5, 5}, glm::vec3(0.5f), glm::vec3(1, 0, 0), gpu::kUnbounded};
            ASSERT_EQ(gpu::march(march_world, ray, march_world.chunks_size).cell,
                      glm::ivec3(16 * chunk + 7, 5, 5))
                << name_of(traversal);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(March, EveryTraversal, ::testing::ValuesIn(all_traversals()), test::traversal_name);

TEST(March, every_family_agrees_with_boxes_in_double_precision) {
    for (const test::NamedWorld& named : test::small_worlds(kMarchSeed + 1)) {
        const MarchWorld march_world = build_march_world(named.world);
        const std::vector<glm::ivec3> solids = test::solid_cells(named.world);
        const int count = solids.size() > 2000 ? 20 : 100;
        for (const test::RayFamily& family : test::ray_families(march_world.size(), count, kMarchSeed)) {
            for (const gpu::Ray& ray : family.rays) {
                const gpu::MarchHit hit = gpu::march(march_world, ray, march_world.chunks_size);
                const test::OracleBounds bounds = test::oracle_bounds(solids, ray, kMargin);
                ASSERT_EQ(test::disagreement(bounds, ray, hit, kMargin), "")
                    << named.name << " " << family.name << " " << print_ray(ray);
            }
        }
    }
}

TEST(March, oracle_rejects_a_hit_moved_by_one_cell_or_dropped) {
    const test::NamedWorld named = std::move(test::small_worlds(kMarchSeed)[9]);
    const MarchWorld march_world = build_march_world(named.world);
    const std::vector<glm::ivec3> solids = test::solid_cells(named.world);
    int hits = 0;
    int moved_caught = 0;
    int dropped_caught = 0;
    for (const gpu::Ray& ray : random_rays(march_world.size(), 200)) {
        gpu::MarchHit hit = gpu::march(march_world, ray, march_world.chunks_size);
        if (hit.face >= gpu::kFaceInside) continue;
        ++hits;
        const test::OracleBounds bounds = test::oracle_bounds(solids, ray, kMargin);
        gpu::MarchHit moved = hit;
        moved.cell.z += 1;
        moved_caught += test::disagreement(bounds, ray, moved, kMargin).empty() ? 0 : 1;
        hit.face = gpu::kFaceMiss;
        dropped_caught += test::disagreement(bounds, ray, hit, kMargin).empty() ? 0 : 1;
    }
    ASSERT_GT(hits, 20);
    EXPECT_GT(moved_caught, hits / 2);
    EXPECT_GT(dropped_caught, hits * 9 / 10);
}

TEST(March, start_in_a_solid_cell_is_a_hit_inside_at_zero) {
    VoxelWorld world(glm::ivec3(0), glm::ivec3(1));
    world.set({3, 3, 3}, 7);
    const MarchWorld march_world = build_march_world(world);
    const gpu::MarchHit hit =
        gpu::march(march_world, gpu::Ray{{3, 3, 3}, glm::vec3(0.25f), glm::vec3(1, 0, 0), gpu::kUnbounded},
                   march_world.chunks_size);
    EXPECT_EQ(hit.face, gpu::kFaceInside);
    EXPECT_EQ(hit.t, 0.0f);
    EXPECT_EQ(hit.material, 7u);
}

// Both planes are crossed at 0.5, x before y: into the corner of the world and then out of it, or out at
// once.
TEST(March, voxel_at_the_border_is_hit_at_the_time_of_leaving_if_entered_before) {
    VoxelWorld world(glm::ivec3(0), glm::ivec3(1));
    world.set({15, 15, 8}, 0);
    for (const Traversal traversal : all_traversals()) {
        const MarchWorld march_world = build_march_world(world, traversal);
        gpu::Ray ray{{14, 15, 8}, glm::vec3(0.5f), glm::vec3(1, 1, 0), gpu::kUnbounded};
        const gpu::MarchHit hit = gpu::march(march_world, ray, march_world.chunks_size);
        EXPECT_EQ(hit.face, 0u) << name_of(traversal);
        EXPECT_EQ(hit.t, 0.5f);
        ray.t_max = 0.5f;
        EXPECT_EQ(gpu::march(march_world, ray, march_world.chunks_size).face, gpu::kFaceMiss);
        const gpu::Ray outwards{{15, 14, 8}, glm::vec3(0.5f), glm::vec3(1, 1, 0), gpu::kUnbounded};
        EXPECT_EQ(gpu::march(march_world, outwards, march_world.chunks_size).face, gpu::kFaceMiss);
    }
}

TEST(March, interval_is_closed_at_the_start_and_open_at_the_end) {
    VoxelWorld world(glm::ivec3(0), glm::ivec3(1));
    world.set({8, 3, 3}, 0);
    const MarchWorld march_world = build_march_world(world);
    gpu::Ray ray{{1, 3, 3}, glm::vec3(0.0f, 0.5f, 0.5f), glm::vec3(1, 0, 0), 7.0f};
    EXPECT_EQ(gpu::march(march_world, ray, march_world.chunks_size).face, gpu::kFaceMiss);
    ray.t_max = std::nextafter(7.0f, 8.0f);
    const gpu::MarchHit hit = gpu::march(march_world, ray, march_world.chunks_size);
    EXPECT_EQ(hit.face, 0u);
    EXPECT_EQ(hit.t, 7.0f);
    ray.t_max = 0.0f;
    EXPECT_EQ(gpu::march(march_world, ray, march_world.chunks_size).face, gpu::kFaceMiss);
}

// A voxel that the ray enters inside the radius but leaves outside it counts: 7.5 voxels to the wall,
// radius 8.
TEST(March, last_voxel_inside_the_radius_is_hit) {
    VoxelWorld world(glm::ivec3(0), glm::ivec3(1));
    world.set({9, 3, 3}, 0);
    const MarchWorld march_world = build_march_world(world);
    const gpu::Ray ray{{1, 3, 3}, glm::vec3(0.5f), glm::vec3(1, 0, 0), 8.0f};
    EXPECT_EQ(gpu::march(march_world, ray, march_world.chunks_size).t, 7.5f);
}

TEST(March, steps_never_exceed_the_planes_of_the_world) {
    for (const test::NamedWorld& named : test::small_worlds(kMarchSeed + 2)) {
        const MarchWorld march_world = build_march_world(named.world);
        const glm::ivec3 size = march_world.size();
        for (const test::RayFamily& family : test::ray_families(size, 200, kMarchSeed)) {
            for (const gpu::Ray& ray : family.rays)
                ASSERT_LE(gpu::march(march_world, ray, march_world.chunks_size).steps,
                          gpu::uint(size.x + size.y + size.z + 3));
        }
    }
}

TEST(March, no_ray_leaves_a_closed_shell) {
    for (const int index :
         {5, 6}) {  // a wall of corners and a shell of faces, both closed for 6-connected walks
        const test::NamedWorld named =
            std::move(test::small_worlds(kMarchSeed)[static_cast<std::size_t>(index)]);
        const MarchWorld march_world = build_march_world(named.world);
        int shot = 0;
        for (const test::RayFamily& family : test::ray_families(march_world.size(), 5000, kMarchSeed + 3)) {
            if (family.name == "short") continue;
            for (const gpu::Ray& ray : family.rays) {
                const glm::ivec3 c = ray.cell;
                const bool below_wall = c.x + c.y + c.z < 40;
                const glm::vec3 d = ray.direction;
                const bool upwards = d.x >= 0 && d.y >= 0 && d.z >= 0;
                const bool inside_shell = glm::all(glm::greaterThan(c, glm::ivec3(1))) &&
                                          glm::all(glm::lessThan(c, glm::ivec3(30)));
                if (index == 6 ? !inside_shell : !(below_wall && upwards)) continue;
                const gpu::MarchHit hit = gpu::march(march_world, ray, march_world.chunks_size);
                if (index == 5 && hit.face == gpu::kFaceMiss) {
                    // It may leave the world below the wall, never above it.
                    const glm::ivec3 last = glm::clamp(hit.cell, glm::ivec3(0), march_world.size() - 1);
                    ASSERT_LT(last.x + last.y + last.z, 40) << print_ray(ray);
                    continue;
                }
                ++shot;
                ASSERT_NE(hit.face, gpu::kFaceMiss) << print_ray(ray);
            }
        }
        EXPECT_GT(shot, 1000);
    }
}

TEST(March, ray_that_leaves_a_face_never_hits_its_own_voxel_and_never_skips_the_neighbour) {
    const test::NamedWorld named = std::move(test::small_worlds(kMarchSeed)[10]);
    const MarchWorld march_world = build_march_world(named.world);
    int spawned = 0;
    for (const gpu::Ray& ray : random_rays(march_world.size(), 3000)) {
        const gpu::MarchHit hit = gpu::march(march_world, ray, march_world.chunks_size);
        if (hit.face >= gpu::kFaceInside) continue;
        const glm::vec3 fraction = gpu::hit_fraction(ray, hit);
        for (const float elevation : {1e-9f, 1e-7f, 1e-3f, 0.5f, 1.0f}) {
            const int a = static_cast<int>(hit.face >> 1);
            glm::vec3 direction(0.0f);
            direction[a] = (hit.face & 1u) != 0 ? elevation : -elevation;
            direction[(a + 1) % 3] = std::sqrt(std::max(0.0f, 1.0f - elevation * elevation));
            const gpu::Ray next = gpu::spawn_ray(hit.cell, hit.face, fraction, direction, gpu::kUnbounded);
            const gpu::MarchHit second = gpu::march(march_world, next, march_world.chunks_size);
            ++spawned;
            if (second.face == gpu::kFaceMiss) continue;
            ASSERT_FALSE(second.cell == hit.cell) << print_ray(next);
            const bool is_inside = named.world.get(next.cell) != VoxelWorld::kEmpty;
            ASSERT_EQ(second.face == gpu::kFaceInside, is_inside) << print_ray(next);
            ASSERT_EQ(second.cell, test::walk_cells(named.world, next).cell);
        }
    }
    EXPECT_GT(spawned, 5000);
}

TEST(March, bad_directions_miss_within_the_step_limit) {
    const test::NamedWorld named = std::move(test::small_worlds(kMarchSeed)[7]);
    const MarchWorld march_world = build_march_world(named.world);
    const float inf = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float bad : {nan, inf, -inf}) {
        for (const glm::vec3 direction :
             {glm::vec3(bad), glm::vec3(bad, 0, 0), glm::vec3(0, bad, 1), glm::vec3(1, 1, bad)}) {
            const gpu::MarchHit hit =
                gpu::march(march_world, gpu::Ray{{1, 1, 1}, glm::vec3(0.5f), direction, gpu::kUnbounded},
                           march_world.chunks_size);
            EXPECT_EQ(hit.fault, gpu::kMarchUnsound);
            EXPECT_EQ(hit.face, gpu::kFaceMiss);
        }
    }
    const gpu::MarchHit hit =
        gpu::march(march_world, gpu::Ray{{1, 1, 1}, glm::vec3(0.5f), glm::vec3(0.0f), gpu::kUnbounded},
                   march_world.chunks_size);
    EXPECT_EQ(hit.face, gpu::kFaceMiss);
}

}  // namespace
}  // namespace voxilux
