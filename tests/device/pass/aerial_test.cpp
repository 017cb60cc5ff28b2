// The air between the camera and its first hits: on the device as the same functions have it in C++, and
// nothing of it where nobody would see it.

#include <gtest/gtest.h>

#include <algorithm>

#include "frame/footprint.h"
#include "frame/frame.h"
#include "scene/atmosphere.h"
#include "scene/technique_choice.h"
#include "shared/sky_path.h"
#include "support/frame_fixture.h"
#include "support/mean_colour.h"
#include "support/sky_model.h"
#include "support/test_scenes.h"

#define VX_SKY_PARAM const std::vector<::voxilux::gpu::uvec4>&scatter,
#define VX_SKY_ARG scatter,
#include "shared/aerial.h"
#undef VX_SKY_PARAM
#undef VX_SKY_ARG

namespace voxilux {
namespace {

using glm::vec3;

// Of the device's exp, sin and pow, as in sky_test.cpp.
constexpr float kAirError = 5e-3f;

// A wall 60 voxels before the camera, which stands 20 voxels high.
Scene far_wall(float metres_per_voxel, float albedo = 1.0f) {
    Scene scene = test::white_scene();
    scene.materials[0].albedo = vec3(albedo);
    test::add_box(scene, {60, -40, -40}, {61, 40, 60});
    scene.sky.model = SkyModel::atmosphere;
    scene.sky.metres_per_voxel = metres_per_voxel;
    scene.sky.altitude_m = 100.0f;
    scene.sun = {.azimuth_deg = 120.0f, .elevation_deg = 25.0f, .irradiance = vec3(1.0f)};
    scene.settings.size = {8, 8};
    scene.camera = Camera{.position = {0.0, 0.0, 20.0}, .yaw_deg = 0.0, .pitch_deg = 0.0, .fov_y_deg = 0.001};
    return scene;
}

gpu::AirPart way_to_wall(const Scene& scene) {
    return gpu::air_part(sky_params(scene), {1.0f, 0.0f, 0.0f}, 20.0f, 60.0f);
}

std::vector<vec3> colours_of(const Scene& scene, Switch aerial) {
    PlanRequest request;
    request.effects.switches = {
        {Effect::aerial, aerial}, {Effect::ao, Switch::off}, {Effect::indirect, Switch::off}};
    test::FrameFixture fixture(scene, request);
    EXPECT_EQ(fixture.plan().has_aerial(), aerial == Switch::on);
    return fixture.render(0).color;
}

gpu::Aerial expected_air(const Scene& scene) {
    const gpu::Air air = sky_params(scene).air;
    return gpu::aerial_of(test::scatter_table(air), air, way_to_wall(scene));
}

TEST(AerialTrace, air_dims_the_wall_and_adds_its_light) {
    for (const float metres : {50.0f, 200.0f}) {
        const gpu::Aerial aerial = expected_air(far_wall(metres));
        const std::vector<vec3> clear = colours_of(far_wall(metres), Switch::off);
        const std::vector<vec3> white = colours_of(far_wall(metres), Switch::on);
        const std::vector<vec3> black = colours_of(far_wall(metres, 0.0f), Switch::on);
        ASSERT_EQ(white.size(), 64u);
        for (std::size_t i = 0; i < white.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                const float expected = aerial.passes[c] * clear[i][c] + aerial.light[c];
                ASSERT_NEAR(white[i][c], expected, kAirError * expected) << metres;
                ASSERT_NEAR(black[i][c], aerial.light[c], kAirError * aerial.light[c]) << metres;
            }
            EXPECT_GT(std::abs(white[i].z - clear[i].z), 3.0f * kAirError * clear[i].z)
                << "the test tells nothing";
        }
    }
}

TEST(AerialTrace, reference_adds_the_same_light_by_paths) {
    Scene scene = far_wall(200.0f, 0.0f);
    scene.settings.size = {64, 64};
    const gpu::Aerial aerial = expected_air(scene);
    choose_technique("sky", "reference", scene.settings);
    test::MeanColour found;
    for (const vec3& value : colours_of(scene, Switch::on))
        found.add(value);
    for (int c = 0; c < 3; ++c) {
        // 3 %: of the light that is scattered more than once, by its table.
        const double tolerance = 4.0 * found.error()[c] + 0.03 * double{aerial.light[c]};
        EXPECT_NEAR(found.mean()[c], double{aerial.light[c]}, tolerance);
        EXPECT_LT(tolerance, 0.2 * double{aerial.light[c]}) << "the test tells nothing";
    }
}

// Four points of the integral are within a tenth there.
TEST(AerialTrace, far_black_wall_looks_like_the_sky_before_it) {
    Scene scene = far_wall(10000.0f, 0.0f);  // 600 km
    scene.sky.altitude_m = 0.0f;
    scene.camera->position.z = 0.0;
    scene.camera->pitch_deg = 0.4;
    const vec3 wall = colours_of(scene, Switch::on).front();
    scene.camera->yaw_deg = 180.0;
    scene.sun.azimuth_deg += 180.0f;  // the same sky, where no wall is
    const vec3 sky = colours_of(scene, Switch::on).front();
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(wall[c], sky[c], 0.1f * sky[c]);
}

std::size_t parts_of_air(const Scene& scene) {
    const Footprint needs = footprint(test::FrameFixture(scene, PlanRequest{}).plan(), record_frame);
    const auto is_aerial = [](const std::string& name) { return name.starts_with("aerial."); };
    return static_cast<std::size_t>(std::ranges::count_if(needs.buffers, is_aerial, &PlannedBuffer::buffer) +
                                    std::ranges::count_if(needs.passes, is_aerial, &PlannedPass::label));
}

TEST(AerialTrace, nothing_of_it_is_recorded_below_a_thousandth) {
    EXPECT_EQ(parts_of_air(far_wall(10.0f)), 3u);
    EXPECT_EQ(parts_of_air(far_wall(0.1f)), 0u);  // 60 voxels are 6 m
    Scene constant = far_wall(10.0f);
    constant.sky.model = SkyModel::constant;
    EXPECT_EQ(parts_of_air(constant), 0u);
}

}  // namespace
}  // namespace voxilux
