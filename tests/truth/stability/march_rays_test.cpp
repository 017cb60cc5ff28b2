// Hard cases of the march, numbered as in README.md: rays. Each test runs on the device and is checked by a
// walk in exact integers, by the plain walk of voxels, or by boxes in double precision.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "shared/sampling.h"
#include "support/exact_walk.h"
#include "support/march_oracle.h"
#include "truth/stability/march_checkers.h"

namespace voxilux {
namespace {

TEST(HardCase, row01_axial_rays_with_either_zero_hit_the_cells_of_the_exact_walk) {
    const VoxelWorld& world = test::world_named("random_0.02");
    std::vector<gpu::Ray> rays;
    for (const std::string family : {"axial", "axial_on_lattice"}) {
        for (gpu::Ray ray : test::family_named(family, world.size(), 300)) {
            for (int signs = 0; signs < 4; ++signs) {
                int bit = 0;
                for (int a = 0; a < 3; ++a) {
                    if (ray.direction[a] == 0.0f)
                        ray.direction[a] = ((signs >> bit++) & 1) != 0 ? -0.0f : 0.0f;
                }
                rays.push_back(ray);
            }
        }
    }
    test::expect_exact_walk(world, rays);
}

TEST(HardCase, row02_rays_in_face_planes_and_along_edges_have_one_first_hit_by_the_half_open_rule) {
    for (const std::string name : {"random_0.02", "random_0.3", "checkerboard"}) {
        const VoxelWorld& world = test::world_named(name);
        std::vector<gpu::Ray> rays = test::family_named("axial_on_lattice", world.size(), 2000);
        for (gpu::Ray ray : test::family_named("corners", world.size(), 4000)) {
            ray.fraction[static_cast<int>(rays.size() % 3)] = 0.0f;
            ray.direction[static_cast<int>(rays.size() % 3)] = 0.0f;
            if (ray.direction != glm::vec3(0.0f)) rays.push_back(ray);
        }
        test::expect_exact_walk(world, rays);
    }
}

TEST(HardCase, row03_rays_through_corners_cross_one_face_at_a_time_in_the_order_x_y_z) {
    for (const std::string name :
         {"random_0.02", "random_0.3", "checkerboard", "diagonal_wall", "corner_wall"}) {
        const VoxelWorld& world = test::world_named(name);
        std::vector<gpu::Ray> rays = test::family_named("corners", world.size(), 4000);
        const std::vector<gpu::Ray> centred = test::family_named("diagonal_from_centre", world.size(), 4000);
        rays.insert(rays.end(), centred.begin(), centred.end());
        test::expect_exact_walk(world, rays);
    }
}

// Two voxels that share only an edge, and rays that meet the edge exactly, in all planes and quadrants.
TEST(HardCase, row03_two_solids_that_touch_along_an_edge_block_every_ray_through_it) {
    std::vector<gpu::Ray> rays;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        VoxelWorld world(glm::ivec3(0), glm::ivec3(1));
        glm::ivec3 low(8);
        glm::ivec3 high(8);
        low[u] -= 1;
        high[v] -= 1;
        world.set(low, 1);
        world.set(high, 2);
        rays.clear();
        for (const int du : {-1, 1}) {
            for (int steps = 1; steps <= 4; ++steps) {
                // Towards the edge at 8 from the empty quadrants, which are the ones with du = dv.
                gpu::Ray ray{glm::ivec3(8), glm::vec3(0.0f), glm::vec3(0.0f), gpu::kUnbounded};
                ray.cell[u] -= du * steps;
                ray.cell[v] -= du * steps;
                ray.fraction[axis] = 0.5f;
                ray.direction[u] = static_cast<float>(du);
                ray.direction[v] = static_cast<float>(du);
                rays.push_back(ray);
            }
        }
        for (const gpu::MarchProbe& probe : test::march_everywhere(world, rays))
            EXPECT_LT(probe.hit.face, gpu::kFaceInside) << "axis " << axis;
        test::expect_exact_walk(world, rays);
    }
}

TEST(HardCase, row04_origins_on_faces_edges_corners_and_in_solids_give_no_negative_time) {
    for (const std::string name : {"full", "random_0.3", "random_0.9"}) {
        const VoxelWorld& world = test::world_named(name);
        const std::vector<gpu::Ray> rays = test::all_families(world.size(), 500);
        const auto got = test::march_everywhere(world, rays);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const bool starts_solid = world.get(rays[i].cell) != VoxelWorld::kEmpty && rays[i].t_max > 0.0f;
            ASSERT_EQ(got[i].hit.face == gpu::kFaceInside, starts_solid) << test::print(rays[i]);
            ASSERT_GE(got[i].hit.t, 0.0f);
            ASSERT_TRUE(!starts_solid || got[i].hit.t == 0.0f) << got[i].hit.t;
        }
    }
}

// From face to face and back: the way back meets the first solid again, on the same face.
TEST(HardCase, row05_reversed_ray_returns_to_the_face_it_left) {
    const VoxelWorld& world = test::world_named("random_0.02");
    const std::vector<MarchWorld> structures = test::all_structures(world);
    std::vector<gpu::MarchProbe> first;
    std::vector<gpu::Ray> out;
    std::vector<gpu::Ray> rays = test::family_named("random", world.size(), 30000);
    const std::vector<gpu::MarchProbe> start = test::march_everywhere(structures, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (start[i].hit.face >= gpu::kFaceInside) continue;
        const gpu::Ray next = gpu::spawn_ray(
            start[i].hit.cell, start[i].hit.face, start[i].fraction,
            glm::reflect(rays[i].direction, gpu::face_normal(start[i].hit.face)), gpu::kUnbounded);
        first.push_back(start[i]);
        out.push_back(next);
    }
    const std::vector<gpu::MarchProbe> second = test::march_everywhere(structures, out);
    std::vector<gpu::Ray> back;
    std::vector<gpu::MarchProbe> origin;
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (second[i].hit.face >= gpu::kFaceInside) continue;
        back.push_back(gpu::spawn_ray(second[i].hit.cell, second[i].hit.face, second[i].fraction,
                                      -out[i].direction, gpu::kUnbounded));
        origin.push_back(first[i]);
    }
    ASSERT_GT(back.size(), 500u);
    const std::vector<gpu::MarchProbe> returned = test::march_everywhere(structures, back);
    const std::vector<glm::ivec3> solids = test::solid_cells(world);
    int moved = 0;
    for (std::size_t i = 0; i < back.size(); ++i) {
        const test::OracleBounds bounds = test::oracle_bounds(solids, back[i], test::kMarchMargin);
        ASSERT_EQ(test::disagreement(bounds, back[i], returned[i].hit, test::kMarchMargin), "")
            << test::print(back[i]);
        moved +=
            returned[i].hit.cell != origin[i].hit.cell || returned[i].hit.face != origin[i].hit.face ? 1 : 0;
    }
    // Only rays within rounding (1e-5 voxel) of an edge may end on the neighbour: some ten in a million.
    EXPECT_LE(moved, 1);
}

TEST(HardCase, row08_directions_without_a_direction_miss_and_are_counted) {
    const float inf = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float denormal = std::numeric_limits<float>::denorm_min();
    std::vector<gpu::Ray> rays;
    for (const float bad : {nan, -nan, inf, -inf}) {
        for (int mask = 1; mask < 8; ++mask) {
            const glm::vec3 d((mask & 1) != 0 ? bad : 1.0f, (mask & 2) != 0 ? bad : 0.0f,
                              (mask & 4) != 0 ? bad : -1.0f);
            rays.push_back({{1, 1, 1}, glm::vec3(0.5f), d, gpu::kUnbounded});
            rays.push_back({{1, 1, 1}, d, glm::vec3(1, 0, 0), gpu::kUnbounded});
            rays.push_back({{-900, 1, 1}, glm::vec3(0.5f), d, gpu::kUnbounded});
        }
    }
    for (const float tiny : {0.0f, -0.0f, denormal, 1e-30f})
        rays.push_back({{1, 1, 1}, glm::vec3(0.5f), glm::vec3(tiny, -tiny, tiny), gpu::kUnbounded});
    const auto got = test::march_everywhere(test::world_named("checkerboard"), rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        ASSERT_EQ(got[i].hit.face, gpu::kFaceMiss) << test::print(rays[i]);
        ASSERT_EQ(got[i].hit.fault, gpu::kMarchUnsound) << test::print(rays[i]);
        ASSERT_EQ(got[i].hit.steps, 0u);
    }
}

TEST(HardCase, row08_directions_of_any_other_length_hit_the_cells_of_the_plain_walk) {
    const VoxelWorld& world = test::world_named("random_0.02");
    for (const float length : {1e-15f, 1e-6f, 0.3f, 7e6f, 1e30f}) {
        std::vector<gpu::Ray> rays = test::family_named("random", world.size(), 500);
        for (gpu::Ray& ray : rays)
            ray.direction *= length;
        test::expect_plain_walk(world, rays);
    }
}

TEST(HardCase, row09_rays_from_up_to_eight_million_voxels_hit_the_voxels_of_the_boxes) {
    const VoxelWorld& world = test::world_named("random_0.02");
    const std::vector<glm::ivec3> solids = test::solid_cells(world);
    for (const float distance : {1e3f, 1e5f, 1e6f, 8e6f}) {
        std::vector<gpu::Ray> rays = test::family_named("random", world.size(), 400);
        for (gpu::Ray& ray : rays)
            ray.cell -= glm::ivec3(glm::floor(glm::dvec3(ray.direction) * static_cast<double>(distance)));
        const auto got = test::march_everywhere(world, rays);
        int hits = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const test::OracleBounds bounds = test::oracle_bounds(solids, rays[i], test::kMarchMargin);
            // The hit's time counts from the border; the boxes' from the start.
            gpu::MarchHit hit = got[i].hit;
            if (got[i].enters == 0) hit.face = gpu::kFaceMiss;
            const double t = static_cast<double>(got[i].entry_t) + static_cast<double>(hit.t);
            if (hit.face == gpu::kFaceMiss) {
                ASSERT_FALSE(bounds.must_by) << test::print(rays[i]);
                continue;
            }
            ++hits;
            const auto found = std::ranges::find(bounds.may, hit.cell, &std::pair<glm::ivec3, double>::first);
            ASSERT_NE(found, bounds.may.end()) << test::print(rays[i]);
            ASSERT_LE(found->second, bounds.must_by.value_or(found->second) + 4.0 * test::kMarchMargin)
                << test::print(rays[i]);
            ASSERT_GT(t, found->second - test::kMarchMargin - t * 2e-7) << test::print(rays[i]);
        }
        EXPECT_GT(hits, 100) << distance;
    }
}

TEST(HardCase, row10_interval_is_closed_at_the_start_open_at_the_end_and_empty_ones_miss) {
    const VoxelWorld& world = test::world_named("one_voxel");  // at (20, 17, 5)
    const gpu::Ray towards{{13, 17, 5}, glm::vec3(0.0f, 0.5f, 0.5f), {1, 0, 0}, 7.0f};
    const gpu::Ray touching{{19, 17, 5}, glm::vec3(1.0f, 0.5f, 0.5f), {1, 0, 0}, 1.0f};
    const gpu::Ray inside{{20, 17, 5}, glm::vec3(0.5f), {1, 0, 0}, 1.0f};
    const auto with_end = [](gpu::Ray ray, float t_max) {
        ray.t_max = t_max;
        return ray;
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float denormal = std::numeric_limits<float>::denorm_min();
    struct Case {
        gpu::Ray ray;
        bool hits;
    };
    const std::vector<Case> cases = {
        {towards, false},
        {with_end(towards, std::nextafter(7.0f, 8.0f)), true},
        {with_end(towards, 0.0f), false},
        {with_end(towards, -1.0f), false},
        {with_end(towards, nan), false},
        {touching, true},
        {with_end(touching, denormal), true},
        {with_end(touching, 0.0f), false},
        {inside, true},
        {with_end(inside, denormal), true},
        {with_end(inside, 0.0f), false},
        {with_end(inside, -1.0f), false},
        {with_end(inside, nan), false},
    };
    std::vector<gpu::Ray> rays;
    for (const Case& c : cases)
        rays.push_back(c.ray);
    const auto got = test::march_everywhere(world, rays);
    for (std::size_t i = 0; i < cases.size(); ++i)
        EXPECT_EQ(got[i].hit.face != gpu::kFaceMiss, cases[i].hits) << i << ": " << test::print(rays[i]);
}

TEST(HardCase, exact_walk_rejects_a_march_of_a_world_with_one_voxel_moved) {
    const VoxelWorld& world = test::world_named("checkerboard");
    VoxelWorld other(glm::ivec3(0), world.chunks());
    for (const glm::ivec3& cell : test::solid_cells(world))
        other.set(cell == glm::ivec3(8, 8, 8) ? glm::ivec3(8, 8, 9) : cell, 1);
    const std::vector<gpu::Ray> rays = test::family_named("axial_on_lattice", world.size(), 4000);
    const auto got = test::march_everywhere(other, rays);
    int caught = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const test::ExactHit want = test::exact_walk(world, rays[i]);
        caught +=
            got[i].hit.face != want.face || (want.face != gpu::kFaceMiss && got[i].hit.cell != want.cell) ? 1
                                                                                                          : 0;
    }
    EXPECT_GT(caught, 0);
}

}  // namespace
}  // namespace voxilux
