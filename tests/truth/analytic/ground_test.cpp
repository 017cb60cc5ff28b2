// The ground against a floor of voxels with the same surface: the same hits, the same light.

#include <gtest/gtest.h>

#include "scene/scene_camera.h"
#include "shared/gpu_types.h"
#include "support/frame_fixture.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

constexpr int kFloor = 300;  // voxels to its border: beyond what the camera sees

Scene pillars(bool has_ground) {
    Scene scene = test::white_scene();
    scene.materials[0].albedo = glm::vec3(0.6f);
    test::add_box(scene, {-2, -2, 0}, {2, 2, 5});
    test::add_box(scene, {4, -6, 0}, {5, 3, 1});
    test::add_box(scene, {-7, 3, 0}, {-5, 4, 9});
    if (!has_ground) test::add_box(scene, {-kFloor, -kFloor, -1}, {kFloor, kFloor, 0});
    scene.ground = {.on = has_ground, .albedo = glm::vec3(0.6f), .height = 0.0};
    scene.sun.on = true;
    scene.camera = test::camera_towards({11.3, -15.7, 9.1}, {0, 0, 1}, 40.0);
    scene.settings.size = {96, 72};
    return scene;
}

glm::dvec3 position_of(const test::FrameFixture& fixture, const gpu::Hit& hit) {
    return glm::dvec3(fixture.march_world().origin + hit.cell) + glm::dvec3(hit.fraction);
}

// How far the hits of two scenes lie apart at most, voxels. One fixture after the other: they share a device.
double farthest(const Scene& a, const Scene& b) {
    test::FrameFixture of_a(a);
    const std::vector<gpu::Hit> in_a = of_a.render(0).hits;
    test::FrameFixture of_b(b);
    const std::vector<gpu::Hit> in_b = of_b.render(0).hits;
    double most = 0.0;
    for (std::size_t i = 0; i < in_a.size(); ++i)
        most = std::max(most, glm::length(position_of(of_a, in_a[i]) - position_of(of_b, in_b[i])));
    return most;
}

TEST(Ground, negative_control_sees_a_ground_that_is_a_thousandth_too_high) {
    Scene high = pillars(true);
    EXPECT_LT(farthest(high, pillars(false)), 1e-4);
    high.ground.height = 1e-3;
    EXPECT_GT(farthest(high, pillars(false)), 1e-4);
}

TEST(Ground, is_hit_where_a_floor_of_voxels_is_and_lit_as_one) {
    test::FrameFixture ground(pillars(true));
    const test::FramePlanes on_ground = ground.render(0);
    const std::vector<gpu::Hit> hits = on_ground.hits;
    test::FrameFixture floor(pillars(false));
    const test::FramePlanes on_floor = floor.render(0);
    int on_plane = 0, lit_apart = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const gpu::Hit& want = on_floor.hits[i];
        ASSERT_NE(hits[i].face, gpu::kFaceMiss) << i;
        const bool is_plane = position_of(floor, want).z == 0.0 && want.face == 5u;
        // Rounding of a distance of 30 voxels.
        ASSERT_LT(glm::length(position_of(ground, hits[i]) - position_of(floor, want)), 1e-4) << i;
        ASSERT_EQ(hits[i].face == gpu::kFaceSphere, is_plane) << i;
        if (!is_plane) continue;
        ++on_plane;
        ASSERT_EQ(position_of(ground, hits[i]).z, 0.0) << i;
        lit_apart += std::abs(on_ground.sun[i] - on_floor.sun[i]) > 1e-6f ? 1 : 0;
    }
    EXPECT_GT(on_plane, 2000);
    EXPECT_LE(lit_apart, 2) << "shadow borders that the rounding of a hit has moved";
}

double mean_beauty(const Scene& scene) {
    const Image image = test::render_validated(scene).image;
    double sum = 0.0;
    for (const float value : image.channels.at("G").pixels)
        sum += static_cast<double>(value);
    return sum / static_cast<double>(pixel_count(image));
}

TEST(Ground, negative_control_sees_a_ground_of_another_albedo) {
    double means[2];
    for (const float albedo : {0.6f, 0.55f}) {
        Scene scene = pillars(true);
        scene.ground.albedo = glm::vec3(albedo);
        scene.settings.size = {48, 36};
        scene.settings.spp = 8;
        means[albedo < 0.6f ? 1 : 0] = mean_beauty(scene);
    }
    EXPECT_GT(std::abs(means[1] / means[0] - 1.0), 0.01);
}

// By paths, by occlusion, and by photons of the emitter: each must treat the ground as it treats voxels.
TEST(GroundNightly, sends_as_much_light_on_as_a_floor_of_voxels) {
    for (const int technique : {0, 1, 2}) {
        double means[2];
        for (const bool has_ground : {false, true}) {
            Scene scene = pillars(has_ground);
            if (technique == 2) {
                scene.materials.push_back(
                    {.albedo = glm::vec3(0.0f), .emission = glm::vec3(20.0f), .surface = Surface::emit});
                test::add_box(scene, {-1, -3, 7}, {1, -1, 8}, 1);
                scene.sky.radiance = glm::vec3(0.0f);
                scene.sun.on = false;
                scene.settings.photons.count = 40000;
                scene.settings.photons.radius = 1.0;
            }
            scene.settings.paths.indirect = technique == 0;
            scene.settings.size = {48, 36};
            scene.settings.spp = 24;
            means[has_ground ? 1 : 0] = mean_beauty(scene);
        }
        // Noise of the mean, which is below a third of this.
        EXPECT_NEAR(means[1] / means[0], 1.0, 0.01) << technique;
        EXPECT_GT(means[0], 0.05) << technique;
    }
}

TEST(Ground, reaches_the_horizon_and_ends_there) {
    Scene scene = test::white_scene();
    scene.ground = {.on = true, .albedo = glm::vec3(0.4f), .height = -3.5};
    scene.camera = Camera{.position = {0.0, 0.0, 2.0}, .yaw_deg = 30.0, .pitch_deg = 0.0, .fov_y_deg = 0.01};
    scene.settings.size = {8, 64};
    const std::vector<gpu::Hit> hits = test::render_first_sample(scene).hits;
    for (std::size_t i = 0; i < hits.size(); ++i)
        EXPECT_EQ(hits[i].face == gpu::kFaceSphere, i / 8 >= 32) << i;
    scene.camera->position.z = -9.0;  // from below, all that is above the horizon
    const std::vector<gpu::Hit> below = test::render_first_sample(scene).hits;
    for (std::size_t i = 0; i < below.size(); ++i)
        EXPECT_EQ(below[i].face == gpu::kFaceSphereInside, i / 8 < 32) << i;
}

TEST(Ground, lies_under_many_spheres_too) {
    Scene scene = test::white_scene();
    scene.ground = {.on = true, .height = 0.0};
    for (int i = 0; i < 40; ++i)
        scene.spheres.push_back({{i % 8 * 3.0, i / 8 * 3.0, 1.0}, 1.0, 0});
    scene.camera = test::camera_down({12.0, 6.0, 40.0}, 60.0);
    scene.settings.size = {40, 40};
    int balls = 0;
    const std::vector<gpu::Hit> hits = test::render_first_sample(scene).hits;
    for (const gpu::Hit& hit : hits) {
        ASSERT_EQ(hit.face, gpu::kFaceSphere);
        balls += hit.sphere != 40u ? 1 : 0;
    }
    EXPECT_GT(balls, 20);
    EXPECT_LT(balls, 1000);
}

}  // namespace
}  // namespace voxilux
