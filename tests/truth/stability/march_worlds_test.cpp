// Hard cases of the march, numbered as in README.md: worlds. Each test runs on the device and is checked by a
// walk in exact integers, by the plain walk of voxels, or by boxes in double precision.

#include <gtest/gtest.h>

#include "shared/hash.h"
#include "support/march_oracle.h"
#include "support/test_scenes.h"
#include "truth/stability/march_checkers.h"

namespace voxilux {
namespace {

// Rays of every family without end from inside a closed shell of `size` cells.
std::vector<gpu::Ray> rays_inside(glm::ivec3 size, int count, std::uint32_t seed) {
    std::vector<gpu::Ray> rays;
    for (const test::RayFamily& family : test::ray_families(size, count / 8, test::kMarchSeed + seed)) {
        if (family.name != "short") rays.insert(rays.end(), family.rays.begin(), family.rays.end());
    }
    for (gpu::Ray& ray : rays)
        ray.cell += 2;  // past the border of the world and the shell itself
    return rays;
}

void expect_no_leak(int size, int count, std::uint32_t seed = 0) {
    Scene scene = test::white_scene();
    for (int axis = 0; axis < 3; ++axis) {
        for (const int at : {0, size + 1}) {
            glm::ivec3 from(0);
            glm::ivec3 to(size + 2);
            from[axis] = at;
            to[axis] = at + 1;
            test::add_box(scene, from, to);
        }
    }
    const std::vector<gpu::Ray> rays = rays_inside(glm::ivec3(size), count, seed);
    const auto got = test::march_everywhere(build_world(scene), rays);
    for (std::size_t i = 0; i < rays.size(); ++i)
        ASSERT_LT(got[i].hit.face, gpu::kFaceInside) << size << ": " << test::print(rays[i]);
}

TEST(HardCase, row11_no_ray_leaves_a_small_closed_shell) {
    for (const int size : {1, 2, 3, 7, 14})
        expect_no_leak(size, 20000);
}

TEST(HardCase, row11_no_ray_leaves_a_large_closed_shell) {
    for (const int size : {15, 16, 17, 62, 130})
        expect_no_leak(size, 20000);
}

TEST(HardCaseNightly, row11_none_of_a_hundred_million_marches_leaves_a_closed_shell) {
    const int rays = 1000000 / static_cast<int>(all_traversals().size());
    for (int size = 1; size <= 100; ++size)
        expect_no_leak(size, rays, static_cast<std::uint32_t>(size));
}

// march_everywhere checks the steps.
TEST(HardCase, row12_no_ray_takes_more_steps_than_the_world_has_planes) {
    for (const test::NamedWorld& named : test::small_worlds(test::kMarchSeed)) {
        SCOPED_TRACE(named.name);
        (void)test::march_everywhere(named.world, test::all_families(named.world.size(), 1000));
    }
}

TEST(HardCase, row13_one_voxel_rod_empty_full_checkerboard_and_thin_walls_agree_with_boxes) {
    for (const std::string name :
         {"one_voxel", "rod", "empty", "full", "checkerboard", "diagonal_wall", "corner_wall", "shell"}) {
        const VoxelWorld& world = test::world_named(name);
        SCOPED_TRACE(name);
        const bool is_big = test::solid_cells(world).size() > 1000;
        test::expect_boxes(world, test::all_families(world.size(), is_big ? 30 : 300));
        test::expect_plain_walk(world, test::all_families(world.size(), 1500));
        test::expect_interval_walk(world, test::all_families(world.size(), 300));
    }
}

// Sizes of scenes; the world adds a border and rounds up to chunks.
TEST(HardCase, row14_sizes_that_are_no_power_of_two_agree_with_the_plain_walk) {
    for (const glm::ivec3 size : {glm::ivec3(1),
                                  {2, 2, 2},
                                  {1, 2, 255},
                                  {256, 1, 2},
                                  {2, 257, 1},
                                  {255, 256, 257},
                                  {1023, 1, 2},
                                  {2, 1, 1023},
                                  {1, 2047, 257},
                                  {2047, 2, 1},
                                  {13, 14, 15},
                                  {16, 17, 31}}) {
        SCOPED_TRACE(std::to_string(size.x) + "x" + std::to_string(size.y) + "x" + std::to_string(size.z));
        Scene scene = test::white_scene();
        test::add_box(scene, glm::ivec3(0), glm::ivec3(1));
        test::add_box(scene, size - 1, size);
        for (std::uint32_t i = 0; i < 200; ++i) {
            const glm::uvec3 bits = gpu::pcg3d(glm::uvec3(i, test::kMarchSeed, 7));
            const glm::ivec3 at = glm::ivec3(bits % glm::uvec3(size));
            test::add_box(scene, at, at + 1);
        }
        const VoxelWorld world = build_world(scene);
        test::expect_plain_walk(world, test::all_families(world.size(), 250));
        test::expect_interval_walk(world, test::all_families(world.size(), 50));
    }
}

// Off each hit at angles to the face from 1e-7 to 89.9999 degrees.
TEST(HardCase, row17_spawned_rays_at_any_angle_neither_hit_their_own_face_nor_skip_a_voxel) {
    const VoxelWorld& world = test::world_named("random_0.3");
    const std::vector<MarchWorld> structures = test::all_structures(world);
    const std::vector<gpu::Ray> rays = test::family_named("random", world.size(), 2000);
    const std::vector<gpu::MarchProbe> hits = test::march_everywhere(structures, rays);
    std::vector<gpu::Ray> spawned;
    std::vector<glm::ivec3> own;
    for (const gpu::MarchProbe& probe : hits) {
        if (probe.hit.face >= gpu::kFaceInside) continue;
        for (const double degrees : {1e-7, 1e-5, 1e-3, 0.1, 10.0, 45.0, 80.0, 89.0, 89.9, 89.999, 89.9999}) {
            const double angle = degrees * 3.14159265358979 / 180.0;
            const int axis = static_cast<int>(probe.hit.face >> 1u);
            glm::vec3 direction(0.0f);
            direction[axis] =
                static_cast<float>(std::sin(angle)) * ((probe.hit.face & 1u) != 0 ? 1.0f : -1.0f);
            direction[(axis + 1) % 3] = static_cast<float>(std::cos(angle) * 0.8);
            direction[(axis + 2) % 3] = static_cast<float>(std::cos(angle) * -0.6);
            spawned.push_back(
                gpu::spawn_ray(probe.hit.cell, probe.hit.face, probe.fraction, direction, gpu::kUnbounded));
            own.push_back(probe.hit.cell);
        }
    }
    ASSERT_GT(spawned.size(), 10000u);
    const std::vector<gpu::MarchProbe> second = test::march_everywhere(structures, spawned);
    for (std::size_t i = 0; i < spawned.size(); ++i) {
        const gpu::MarchHit want = test::walk_cells(world, spawned[i]);
        ASSERT_EQ(second[i].hit.face, want.face) << test::print(spawned[i]);
        if (want.face == gpu::kFaceMiss) continue;
        ASSERT_EQ(second[i].hit.cell, want.cell) << test::print(spawned[i]);
        ASSERT_NE(second[i].hit.cell, own[i]) << test::print(spawned[i]);
    }
}

}  // namespace
}  // namespace voxilux
