// The pass primary.march against the same code as C++ (every bit) and against boxes in double precision
// (every pixel).

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "passes/plane.h"
#include "support/frame_fixture.h"
#include "support/march_probe.h"
#include "support/pixel_oracle.h"
#include "support/same_bits.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

// Voxels. A hit may be off by the rounding of a position inside the world, 2^-23 of 32 voxels, many times
// over.
constexpr double kMargin = 1e-4;
// Relative rounding of a distance, with room for the sum of entry and march.
constexpr double kDistanceError = 4e-7;

// A floor, a wall, a staircase, and voxels that touch along edges and corners only.
Scene small_scene() {
    Scene scene = test::white_scene();
    test::add_box(scene, {-6, -6, -1}, {6, 6, 0});
    test::add_box(scene, {-6, 5, 0}, {6, 6, 5});
    for (int i = 0; i < 4; ++i)
        test::add_box(scene, {-5 + i, 0, i}, {-4 + i, 3, i + 1});
    for (const glm::ivec3 corner : {glm::ivec3(2, -3, 1), {3, -2, 1}, {4, -1, 2}, {5, -2, 3}})
        test::add_box(scene, corner, corner + 1);
    scene.settings.size = {33, 25};
    return scene;
}

// The same for a camera inside: a closed room of 8^3 cells with a pillar.
Scene room() {
    Scene scene = test::white_scene();
    for (int axis = 0; axis < 3; ++axis) {
        for (const int at : {-1, 8}) {
            glm::ivec3 from(-1);
            glm::ivec3 to(9);
            from[axis] = at;
            to[axis] = at + 1;
            test::add_box(scene, from, to);
        }
    }
    test::add_box(scene, {5, 5, 0}, {6, 6, 8});
    scene.settings.size = {33, 25};
    return scene;
}

std::vector<glm::ivec3> local_cells(const Scene& scene, glm::ivec3 origin) {
    std::vector<glm::ivec3> cells = test::scene_cells(scene);
    for (glm::ivec3& cell : cells)
        cell -= origin;
    return cells;
}

// What primary_march.comp does for a pixel, in C++.
gpu::Hit hit_in_cpp(const MarchWorld& march_world, const gpu::Ray& ray) {
    const gpu::MarchProbe probe = gpu::probe_march(march_world, ray, march_world.chunks_size);
    gpu::Hit hit{.cell = glm::ivec3(-1), .face = gpu::kFaceMiss, .fraction = glm::vec3(0.0f)};
    if (probe.enters == 0 || probe.hit.face == gpu::kFaceMiss) return hit;
    return {
        probe.hit.cell, probe.hit.face, probe.fraction, probe.entry_t + probe.hit.t, probe.hit.material, 0};
}

struct Marched {
    std::vector<gpu::Hit> hits;
    std::vector<gpu::Ray> rays;
    std::vector<glm::ivec3> solids;  // local
    int hit_count = 0;
};

// Marches on the device and expects the bits of C++.
Marched march_picture(const Scene& scene) {
    test::FrameFixture fixture(scene);
    Marched marched{.hits = fixture.render(0).hits,
                    .solids = local_cells(scene, fixture.march_world().origin)};
    std::vector<gpu::Hit> want;
    const gpu::uint sequence = sequence_id(scene.settings.sequence);
    for (gpu::uint y = 0; y < fixture.params().height; ++y) {
        for (gpu::uint x = 0; x < fixture.params().width; ++x) {
            marched.rays.push_back(gpu::camera_ray(
                fixture.params(), static_cast<gpu::uint>(fixture.plan().projection), sequence, x, y));
            want.push_back(hit_in_cpp(fixture.march_world(), marched.rays.back()));
            marched.hit_count += want.back().face != gpu::kFaceMiss ? 1 : 0;
        }
    }
    const auto difference = test::differing_bits<gpu::Hit>(marched.hits, want);
    EXPECT_EQ(difference.count, 0u) << "pixel " << difference.first << ": " << difference.detail;
    return marched;
}

// Also expects every pixel to agree with the boxes.
Marched expect_oracle(const Scene& scene) {
    Marched marched = march_picture(scene);
    for (std::size_t i = 0; i < marched.hits.size(); ++i) {
        const double t_margin = kMargin + kDistanceError * static_cast<double>(marched.hits[i].t);
        EXPECT_EQ(test::hit_disagreement(marched.solids, test::to_double(marched.rays[i]), marched.hits[i],
                                         kMargin, t_margin),
                  "")
            << "pixel " << i << " ray " << test::print(marched.rays[i]);
        if (testing::Test::HasFailure()) break;
    }
    return marched;
}

TEST(PrimaryMarch, every_pixel_from_many_sides_agrees_with_the_oracle) {
    for (const glm::dvec3 position : {glm::dvec3(14.3, -17.1, 11.7),
                                      {-13.9, -15.2, 3.4},
                                      {9.1, 16.6, -9.3},
                                      {0.3, -0.2, 22.5},
                                      {-0.4, 0.7, -14.0},
                                      {-21.0, 2.5, 2.5}}) {
        Scene scene = small_scene();
        scene.camera = test::camera_towards(position, {0, 0, 1}, 40.0);
        EXPECT_GT(expect_oracle(scene).hit_count, 60) << position.x;
    }
}

TEST(PrimaryMarch, axial_view_from_an_integer_position_agrees_with_the_oracle) {
    for (const double yaw : {0.0, 90.0, 180.0, 270.0}) {
        Scene scene = small_scene();
        scene.camera = Camera{.position = glm::dvec3(0, -1, 1), .yaw_deg = yaw, .fov_y_deg = 60.0};
        EXPECT_GT(expect_oracle(scene).hit_count, 60) << yaw;
    }
}

// The view is so narrow that every ray is exactly axial, along lattice lines of the scene. A ray in a face
// plane belongs to the cell above it.
TEST(PrimaryMarch, rays_exactly_along_lattice_lines_hit_the_cell_that_owns_the_line) {
    Scene scene = small_scene();
    scene.camera = Camera{.position = glm::dvec3(-5, -20, 0), .yaw_deg = 90.0, .fov_y_deg = 1e-20};
    const Marched marched = march_picture(scene);
    for (const gpu::Hit& hit : marched.hits) {
        ASSERT_EQ(hit.face, 2u);
        ASSERT_EQ(hit.cell, marched.solids.front() - glm::ivec3(-6, -6, -1) + glm::ivec3(-5, 0, 0));
        ASSERT_EQ(hit.fraction, glm::vec3(0.0f));
        ASSERT_EQ(hit.t, 20.0f);
    }
}

Camera orthographic_towards(glm::dvec3 position, glm::dvec3 target, double pixels_per_voxel) {
    Camera camera = test::camera_towards(position, target);
    camera.projection = Projection::orthographic;
    camera.pixels_per_voxel = pixels_per_voxel;
    return camera;
}

TEST(PrimaryMarch, parallel_rays_from_many_sides_agree_with_the_oracle) {
    for (const glm::dvec3 position : {glm::dvec3(14.3, -17.1, 11.7),
                                      {0.5, -12.0, 0.5},
                                      {30.0, 0.25, 1.0},
                                      {0.3, -0.2, 22.5},
                                      {-1e5, 2e5, 7e4},
                                      {1.3, 2.1, 3.4}}) {
        for (const double scale : {1.7, 2.0, 3.0}) {
            Scene scene = small_scene();
            scene.camera = orthographic_towards(position, {0.5, 0, 1}, scale);
            EXPECT_GT(expect_oracle(scene).hit_count, 60) << position.x << " scale " << scale;
        }
    }
}

// Parallel rays that point along an axis: the cells of a side in rows and columns.
TEST(PrimaryMarch, parallel_rays_along_an_axis_hit_whole_blocks_of_pixels) {
    Scene scene = small_scene();
    scene.settings.size = {36, 24};
    scene.camera = orthographic_towards({0, -20, 2}, {0, 0, 2}, 3.0);
    const std::vector<gpu::Hit> hits = march_picture(scene).hits;
    for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 36; ++x) {
            const auto at = [&](int column, int row) {
                return hits[static_cast<std::size_t>(36 * row + column)];
            };
            const gpu::Hit block = at(x / 3 * 3, y / 3 * 3);
            ASSERT_EQ(at(x, y).face, block.face) << x << " " << y;
            ASSERT_EQ(at(x, y).cell, block.cell) << x << " " << y;
        }
    }
}

// The device's sine is not that of C++, so rays agree only up to rounding.
TEST(PrimaryMarch, panoramas_see_what_the_oracle_does) {
    for (const Projection projection : {Projection::equirectangular, Projection::fisheye}) {
        Scene scene = small_scene();
        scene.camera = test::camera_towards({1.3, -4.1, 3.4}, {0, 3, 0}, 170.0);
        scene.camera->projection = projection;
        test::FrameFixture fixture(scene);
        const std::vector<gpu::Hit> hits = fixture.render(0).hits;
        const std::vector<glm::ivec3> solids = local_cells(scene, fixture.march_world().origin);
        int found = 0;
        for (std::size_t i = 0; i < hits.size(); ++i) {
            const gpu::Ray ray = gpu::camera_ray(
                fixture.params(), static_cast<gpu::uint>(projection), sequence_id(scene.settings.sequence),
                static_cast<gpu::uint>(i % 33), static_cast<gpu::uint>(i / 33));
            found += hits[i].face != gpu::kFaceMiss ? 1 : 0;
            ASSERT_EQ(test::hit_disagreement(solids, test::to_double(ray), hits[i], kMargin, kMargin), "")
                << "pixel " << i << " " << test::print(ray);
        }
        EXPECT_GT(found, 200);
    }
}

TEST(PrimaryMarch, camera_a_fifth_of_a_voxel_from_a_wall_agrees_with_the_oracle) {
    Scene scene = small_scene();
    scene.camera =
        Camera{.position = glm::dvec3(0.5, 4.8, 2.3), .yaw_deg = 75.0, .pitch_deg = 10.0, .fov_y_deg = 80.0};
    const Marched marched = expect_oracle(scene);
    EXPECT_EQ(marched.hit_count, 33 * 25);
    for (const gpu::Hit& hit : marched.hits)
        ASSERT_LT(hit.t, 1.0f);
}

TEST(PrimaryMarch, camera_inside_a_solid_hits_it_at_zero_everywhere) {
    Scene scene = small_scene();
    scene.camera = Camera{.position = glm::dvec3(1.5, 2.25, -0.5), .yaw_deg = 20.0};
    for (const gpu::Hit& hit : expect_oracle(scene).hits) {
        ASSERT_EQ(hit.face, gpu::kFaceInside);
        ASSERT_EQ(hit.t, 0.0f);
    }
}

TEST(PrimaryMarch, camera_inside_a_closed_room_never_sees_out) {
    for (const glm::dvec3 position :
         {glm::dvec3(1.3, 2.1, 4.4), {0, 0, 0}, {4, 4, 4}, {7.999, 0.001, 7.999}}) {
        for (const double yaw : {0.0, 45.0, 200.0}) {
            Scene scene = room();
            scene.camera =
                Camera{.position = position, .yaw_deg = yaw, .pitch_deg = -35.0, .fov_y_deg = 120.0};
            EXPECT_EQ(expect_oracle(scene).hit_count, 33 * 25) << position.x << " yaw " << yaw;
        }
    }
}

TEST(PrimaryMarch, far_cameras_hit_the_voxels_of_the_oracle) {
    for (const double distance : {3000.0, 1e5, 1e6, 8e6}) {
        Scene scene = small_scene();
        const glm::dvec3 position = glm::normalize(glm::dvec3(0.3, -0.8, 0.5)) * distance;
        scene.camera = test::camera_towards(position, {0, 0, 1}, 16.0 / distance * 57.3);
        EXPECT_GT(expect_oracle(scene).hit_count, 60) << distance;
    }
}

// The world of the scene has its corner at (-7, -7, -2) and 16 cells per axis.
TEST(PrimaryMarch, cameras_exactly_on_the_border_of_the_world_agree_with_the_oracle) {
    for (const glm::dvec3 position : {glm::dvec3(0, 0, 14),
                                      {9, 0, 2},
                                      {-7, 1, 2},
                                      {0, 9, 6},
                                      {1, -7, 3},
                                      {0, 0, -2},
                                      {9, 9, 14},
                                      {-7, -7, 14}}) {
        Scene scene = small_scene();
        scene.camera = test::camera_towards(position, {0.1, 0.2, 0.3}, 60.0);
        EXPECT_GT(expect_oracle(scene).hit_count, 60) << position.x << " " << position.y << " " << position.z;
    }
}

TEST(PrimaryMarch, world_behind_or_beside_the_camera_is_missed) {
    for (const glm::dvec3 side :
         {glm::dvec3(1, 0, 0), {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}) {
        Scene scene = small_scene();
        scene.camera = test::camera_towards(40.0 * side, 80.0 * side, 60.0);
        EXPECT_EQ(expect_oracle(scene).hit_count, 0) << "behind";
        scene.camera->yaw_deg += 90.0;
        scene.camera->pitch_deg = 0.0;
        EXPECT_EQ(expect_oracle(scene).hit_count, 0) << "beside";
    }
}

TEST(PrimaryMarch, oracle_rejects_a_picture_seen_from_a_tenth_of_a_voxel_beside) {
    Scene scene = small_scene();
    scene.camera = test::camera_towards({14.3, -17.1, 11.7}, {0, 0, 1}, 40.0);
    const Marched marched = march_picture(scene);
    int caught = 0;
    for (std::size_t i = 0; i < marched.hits.size(); ++i) {
        test::DoubleRay ray = test::to_double(marched.rays[i]);
        ray.origin.x += 0.1;
        const double t_margin = kMargin + kDistanceError * static_cast<double>(marched.hits[i].t);
        caught +=
            test::hit_disagreement(marched.solids, ray, marched.hits[i], kMargin, t_margin).empty() ? 0 : 1;
    }
    EXPECT_GT(caught, marched.hit_count * 9 / 10);
}

}  // namespace
}  // namespace voxilux
