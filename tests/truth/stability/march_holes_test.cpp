// Holes that earlier voxel renderers had in their marches, numbered as in the second part of README.md. Each
// test runs on the device through every structure.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>

#include "shared/sampling.h"
#include "support/interval_walk.h"
#include "truth/stability/march_checkers.h"

namespace voxilux {
namespace {

glm::vec3 unit(int axis, float length) {
    glm::vec3 v(0.0f);
    v[axis] = length;
    return v;
}

// First filled cell of a row of cells from `cell` on, that one included; `step` is -1 or 1.
std::optional<glm::ivec3> first_filled(const VoxelWorld& world, glm::ivec3 cell, int axis, int step) {
    for (; world.contains(cell); cell[axis] += step)
        if (world.get(cell) != VoxelWorld::kEmpty) return cell;
    return std::nullopt;
}

// What cosine sampling yields for u.y = 0, and the view of a camera with yaw 0 in the middle of an odd width:
// one component is exactly zero, of either sign.
TEST(EarlierHole, b01_components_of_exactly_zero_give_no_nan_and_no_endless_march) {
    const VoxelWorld& world = test::world_named("random_0.02");
    std::vector<gpu::Ray> rays = test::family_named("random", world.size(), 3000);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto face = static_cast<gpu::uint>(i % 6);
        const float u = static_cast<float>(i / 6) / 512.0f;
        rays[i].direction = i < 2400 ? gpu::cosine_on_face(face, glm::vec2(std::min(u, 0.999f), 0.0f))
                                     : gpu::face_normal(face);
        for (int a = 0; a < 3; ++a)
            if (rays[i].direction[a] == 0.0f && i % 4 < 2) rays[i].direction[a] = -0.0f;
        if (i % 5 == 0) rays[i].fraction = glm::round(rays[i].fraction);
    }
    const auto zero = [](const gpu::Ray& ray) {
        return ray.direction.x == 0.0f || ray.direction.y == 0.0f || ray.direction.z == 0.0f;
    };
    EXPECT_GT(std::ranges::count_if(rays, zero), 500);
    test::expect_plain_walk(world, rays);
    test::expect_interval_walk(world, rays);
}

// A camera at an integer position outside, and an axial view: the slab test's 0 * inf.
TEST(EarlierHole, b02_axial_views_from_integer_positions_outside_enter_at_an_exact_time) {
    const VoxelWorld& world = test::world_named("random_0.02");
    const std::vector<gpu::Ray> family = test::family_named("axial_on_lattice", world.size(), 400);
    std::vector<gpu::Ray> rays;
    std::vector<int> travelled;  // whole voxels to the border
    for (int direction = 0; direction < 6; ++direction) {
        const int axis = direction / 2;
        const int step = direction % 2 == 0 ? -1 : 1;
        for (int i = 0; i < 400; ++i) {
            gpu::Ray ray =
                test::family_named("axial_on_lattice", world.size(), 400)[static_cast<std::size_t>(i)];
            const int distance = 1 + i * i;
            ray.cell[axis] = step > 0 ? -distance : world.size()[axis] - 1 + distance;
            ray.fraction[axis] = step > 0 ? 0.0f : 1.0f;
            ray.direction = unit(axis, static_cast<float>(step));
            rays.push_back(ray);
            travelled.push_back(distance);
        }
    }
    const auto got = test::march_everywhere(world, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto axis = static_cast<int>(i / 800);
        const int step = i / 400 % 2 == 0 ? -1 : 1;
        glm::ivec3 cell = rays[i].cell;
        cell[axis] = step > 0 ? 0 : world.size()[axis] - 1;
        ASSERT_EQ(got[i].enters, 1u) << test::print(rays[i]);
        ASSERT_EQ(got[i].entry_t, static_cast<float>(travelled[i]));
        const auto want = first_filled(world, cell, axis, step);
        ASSERT_EQ(got[i].hit.face != gpu::kFaceMiss, want.has_value()) << test::print(rays[i]);
        if (!want) continue;
        ASSERT_EQ(got[i].hit.cell, *want) << test::print(rays[i]);
        ASSERT_EQ(got[i].hit.t, static_cast<float>(std::abs((*want)[axis] - cell[axis])));
    }
}

// A wall at 7.5 voxels and radius 8, then every distance and radius around, along every direction.
TEST(EarlierHole, b06_a_voxel_entered_inside_the_radius_counts_whatever_it_leaves) {
    for (int direction = 0; direction < 6; ++direction) {
        const int axis = direction / 2;
        const int step = direction % 2 == 0 ? -1 : 1;
        VoxelWorld world(glm::ivec3(0), glm::ivec3(2));
        glm::ivec3 wall(16);
        world.set(wall, 1);
        std::vector<gpu::Ray> rays;
        std::vector<float> distances;
        for (int eighths = 0; eighths < 96; ++eighths) {
            for (const float radius : {1.0f, 7.5f, std::nextafter(7.5f, 8.0f), 8.0f, 8.5f}) {
                gpu::Ray ray{wall, glm::vec3(0.5f), unit(axis, static_cast<float>(step)), radius};
                const float passed = static_cast<float>(eighths % 8) / 8.0f;  // part of the first cell
                ray.cell[axis] -= step * (1 + eighths / 8);
                ray.fraction[axis] = step > 0 ? passed : 1.0f - passed;
                rays.push_back(ray);
                distances.push_back(static_cast<float>(eighths / 8 + 1) - passed);
            }
        }
        const auto got = test::march_everywhere(world, rays);
        for (std::size_t i = 0; i < rays.size(); ++i)
            ASSERT_EQ(got[i].hit.face != gpu::kFaceMiss, distances[i] < rays[i].t_max)
                << distances[i] << " " << test::print(rays[i]);
    }
}

// Voxels. Error of a hit's position inside its cell, seen from a camera 3000 voxels away: time and planes
// inside the world round at 2^-24 of at most 60 voxels, a few times.
constexpr double kPositionError = 2e-5;

TEST(EarlierHole, b07_hits_seen_from_3000_voxels_keep_their_place_and_start_no_ray_in_a_solid) {
    const VoxelWorld& world = test::world_named("random_0.3");
    std::vector<gpu::Ray> rays = test::family_named("random", world.size(), 20000);
    for (gpu::Ray& ray : rays)
        ray.cell -= glm::ivec3(glm::floor(ray.direction * 3000.0f));
    const auto got = test::march_everywhere(world, rays);
    int hits = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const gpu::MarchHit& hit = got[i].hit;
        if (got[i].enters == 0 || hit.face >= gpu::kFaceInside) continue;
        ++hits;
        const int axis = static_cast<int>(hit.face >> 1u);
        ASSERT_EQ(got[i].fraction[axis], static_cast<float>(hit.face & 1u));
        const gpu::Ray next =
            gpu::spawn_ray(hit.cell, hit.face, got[i].fraction, gpu::face_normal(hit.face), gpu::kUnbounded);
        ASSERT_EQ(world.get(next.cell), VoxelWorld::kEmpty) << test::print(rays[i]);
        const glm::dvec3 origin = glm::dvec3(rays[i].cell) + glm::dvec3(rays[i].fraction);
        const glm::dvec3 direction(rays[i].direction);
        const double plane = static_cast<double>(hit.cell[axis]) + static_cast<double>(hit.face & 1u);
        const glm::dvec3 truth = origin + direction * ((plane - origin[axis]) / direction[axis]);
        // A grazing ray moves far along the face for each rounding across it.
        const double slope = 1.0 / std::abs(direction[axis]);
        for (int a = 0; a < 3; ++a)
            ASSERT_NEAR(static_cast<double>(hit.cell[a]) + static_cast<double>(got[i].fraction[a]), truth[a],
                        kPositionError * std::max(1.0, slope * std::abs(direction[a])))
                << test::print(rays[i]);
    }
    EXPECT_GT(hits, 1000);
}

// Walls of voxels that touch along edges only: no ray passes, least of all those at 45 degrees through
// lattice points.
TEST(EarlierHole, b08_diagonal_walls_of_voxels_that_share_edges_let_no_ray_through) {
    for (const std::string name : {"diagonal_wall", "corner_wall"}) {
        const VoxelWorld& world = test::world_named(name);
        const bool is_flat = name == "diagonal_wall";
        const auto height = [&](glm::ivec3 c) { return c.x + c.y + (is_flat ? 0 : c.z); };
        const int wall = is_flat ? 31 : 40;
        std::vector<gpu::Ray> rays;
        for (const test::RayFamily& family : test::ray_families(world.size(), 4000, test::kMarchSeed)) {
            for (gpu::Ray ray : family.rays) {
                if (height(ray.cell) >= wall) continue;
                ray.direction = glm::abs(ray.direction);
                if (is_flat) ray.direction.z = 0.0f;
                if (!gpu::is_sound(ray)) continue;
                ray.t_max = gpu::kUnbounded;
                rays.push_back(ray);
            }
        }
        // Rays that leave the world below the wall may miss; the walk finds them.
        int stopped = 0;
        const auto got = test::march_everywhere(world, rays);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const gpu::MarchHit walked = test::walk_cells(world, rays[i]);
            ASSERT_EQ(test::difference(got[i].hit, walked), "") << test::print(rays[i]);
            ASSERT_LE(height(glm::min(walked.cell, world.size() - 1)), wall) << test::print(rays[i]);
            stopped += walked.face != gpu::kFaceMiss ? 1 : 0;
        }
        EXPECT_GT(stopped, 5000) << name;
    }
}

TEST(EarlierHole, b09_a_wall_a_fifth_of_a_voxel_before_the_camera_is_seen_from_every_side) {
    constexpr float kGap = 0.2f;
    for (int direction = 0; direction < 6; ++direction) {
        const int axis = direction / 2;
        const bool ahead = direction % 2 == 1;
        VoxelWorld world(glm::ivec3(0), glm::ivec3(2));
        for (int i = 0; i < 32 * 32; ++i) {
            glm::ivec3 cell(16);
            cell[(axis + 1) % 3] = i % 32;
            cell[(axis + 2) % 3] = i / 32;
            world.set(cell, 1);
        }
        std::vector<gpu::Ray> rays;
        for (int i = 0; i < 21 * 21; ++i) {
            gpu::Ray ray{glm::ivec3(16), glm::vec3(0.5f), unit(axis, ahead ? 1.0f : -1.0f), gpu::kUnbounded};
            ray.cell[axis] += ahead ? -1 : 1;
            ray.fraction[axis] = ahead ? 1.0f - kGap : kGap;
            ray.direction[(axis + 1) % 3] = static_cast<float>(i % 21 - 10) / 8.0f;
            ray.direction[(axis + 2) % 3] = static_cast<float>(i / 21 - 10) / 8.0f;
            rays.push_back(ray);
        }
        for (const gpu::MarchProbe& probe : test::march_everywhere(world, rays)) {
            ASSERT_EQ(probe.hit.face, static_cast<gpu::uint>(direction ^ 1));
            ASSERT_EQ(probe.hit.cell[axis], 16);
            ASSERT_FLOAT_EQ(probe.hit.t, kGap);
        }
        test::expect_plain_walk(world, rays);
    }
}

TEST(EarlierHole, b10_a_camera_inside_a_solid_hits_that_voxel_at_zero) {
    const VoxelWorld& world = test::world_named("random_0.3");
    std::vector<gpu::Ray> rays;
    for (gpu::Ray ray : test::all_families(world.size(), 400)) {
        if (world.get(ray.cell) == VoxelWorld::kEmpty) continue;
        ray.t_max = gpu::kUnbounded;
        rays.push_back(ray);
    }
    ASSERT_GT(rays.size(), 500u);
    const auto got = test::march_everywhere(world, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        ASSERT_EQ(got[i].hit.face, gpu::kFaceInside);
        ASSERT_EQ(got[i].hit.cell, rays[i].cell);
        ASSERT_EQ(got[i].hit.t, 0.0f);
        ASSERT_EQ(got[i].hit.material, world.get(rays[i].cell) & gpu::kVoxelPayloadMask);
    }
}

// The device and C++ must find the same cells, bit for bit, also where cells are negative and large.
TEST(EarlierHole, b17_cells_of_rays_from_far_and_negative_places_are_those_of_cpp_bit_for_bit) {
    const VoxelWorld& world = test::world_named("random_0.02");
    std::vector<gpu::Ray> rays = test::all_families(world.size(), 500);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        constexpr std::array kDistances = {1.0f, 60.0f, 4097.0f, 1e6f, 8e6f};
        rays[i].cell -= glm::ivec3(glm::floor(rays[i].direction * kDistances[i % kDistances.size()]));
    }
    for (const MarchWorld& structure : test::all_structures(world)) {
        const auto got = test::march_on_device(structure, rays);
        const auto want = test::march_in_cpp(structure, rays);
        for (std::size_t i = 0; i < rays.size(); ++i)
            ASSERT_EQ(std::memcmp(&got[i], &want[i], sizeof got[i]), 0)
                << name_of(structure.traversal) << " " << test::print(rays[i]);
    }
}

}  // namespace
}  // namespace voxilux
