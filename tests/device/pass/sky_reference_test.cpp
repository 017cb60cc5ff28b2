// The technique `sky=reference` on the device: paths through the air, as the same functions trace them in
// C++.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "frame/footprint.h"
#include "frame/frame.h"
#include "scene/atmosphere.h"
#include "scene/technique_choice.h"
#include "shared/sky_path.h"
#include "support/frame_fixture.h"
#include "support/mean_colour.h"
#include "support/sky_model.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

using glm::vec3;

constexpr double kTracedSigmas = 4.0;

Scene traced_floor(float sun_elevation_deg) {
    Scene scene = test::white_scene();
    test::add_box(scene, {-40, -40, -1}, {40, 40, 0});
    scene.sky.model = SkyModel::atmosphere;
    scene.sun = {.azimuth_deg = 30.0f, .elevation_deg = sun_elevation_deg, .irradiance = vec3(1.0f)};
    scene.settings.size = {16, 16};
    scene.camera = test::camera_down({0.0, 0.0, 20.0}, 40.0);
    choose_technique("sky", "reference", scene.settings);
    return scene;
}

// Rounding turns some paths another way at a choice.
constexpr int kOtherwise = 13;  // of 256

TEST(SkyReference, camera_sees_the_paths_of_the_shared_functions) {
    for (const float sun_deg : {-4.0f, 20.0f}) {
        Scene scene = traced_floor(sun_deg);
        scene.camera =
            Camera{.position = {0.0, 0.0, 5.0}, .yaw_deg = 100.0, .pitch_deg = 25.0, .fov_y_deg = 0.001};
        const gpu::SkyParams sky = sky_params(scene);
        const test::FramePlanes planes = test::render_first_sample(scene);
        int otherwise = 0;
        for (gpu::uint i = 0; i < planes.sky.size(); ++i) {
            const vec3 expected = gpu::traced_sky(sky, test::direction_of(100.0, 25.0),
                                                  gpu::air_noise({i, 0, scene.settings.seed}, 0));
            ASSERT_EQ(planes.color[i], planes.sky[i]);
            otherwise += glm::length(planes.sky[i] - expected) > 0.01f * glm::length(expected) ? 1 : 0;
        }
        EXPECT_LE(otherwise, kOtherwise) << sun_deg;
        EXPECT_NE(planes.sky[0], planes.sky[1]) << "the test tells nothing";
    }
}

vec3 light_of_tables(const Scene& scene) {
    const gpu::SkyParams sky = sky_params(scene);
    const std::vector<vec3> view = test::view_table(test::scatter_table(sky.air), sky);
    vec3 sum(0.0f);
    for (gpu::uint i = 0; i < gpu::kFaceRays; ++i) {
        const gpu::FaceRay ray = gpu::face_ray(sky, i);
        sum += std::max(ray.direction.z, 0.0f) * ray.weight * gpu::sky_radiance(view, sky, ray.direction);
    }
    return sum * gpu::kInversePi;
}

// `off`: effects that are not rendered.
test::MeanColour light_on_floor(const Scene& scene, std::initializer_list<Effect> off) {
    PlanRequest request;
    for (const Effect effect : off)
        request.effects.switches[effect] = Switch::off;
    test::FrameFixture fixture(scene, request);
    test::MeanColour mean;
    for (std::uint32_t sample = 0; sample < 16; ++sample)
        for (const vec3& value : fixture.render(sample).color)
            mean.add(value);
    return mean;
}

// Tables are within 2 % of the truth there.
TEST(SkyReference, open_floor_receives_the_light_of_the_sky_by_rays_and_by_paths) {
    Scene scene = traced_floor(30.0f);
    scene.settings.sequence = Sequence::white;
    const vec3 expected = light_of_tables(scene);
    for (const bool by_paths : {false, true}) {
        if (by_paths) choose_technique("indirect", "paths", scene.settings);
        const auto found = by_paths ? light_on_floor(scene, {Effect::sun})
                                    : light_on_floor(scene, {Effect::sun, Effect::indirect});
        for (int c = 0; c < 3; ++c) {
            const double tolerance = kTracedSigmas * found.error()[c] + 0.02 * double{expected[c]};
            EXPECT_NEAR(found.mean()[c], double{expected[c]}, tolerance) << by_paths;
            EXPECT_GT(0.2 * double{expected[c]}, tolerance) << "the test tells nothing";
        }
    }
}

TEST(SkyReference, pixels_do_not_depend_on_how_the_image_is_cut) {
    const Scene scene = traced_floor(10.0f);
    const auto sums = [&](std::uint32_t rows) {
        test::FrameFixture fixture(scene);
        for (std::uint32_t sample = 0; sample < 2; ++sample)
            fixture.render_tile(sample, rows);
        return fixture.film_sums("beauty_a");
    };
    EXPECT_EQ(sums(16), sums(3));
}

std::vector<std::string> sky_buffers(const Scene& scene) {
    std::vector<std::string> names;
    for (const PlannedBuffer& planned : footprint(test::FrameFixture(scene, PlanRequest{}).plan()).buffers)
        if (planned.buffer.starts_with("sky.") && planned.buffer != "sky.light")
            names.push_back(planned.buffer);
    return names;
}

TEST(SkyReference, paths_need_no_tables) {
    Scene scene = traced_floor(10.0f);
    choose_technique("indirect", "paths", scene.settings);
    EXPECT_EQ(sky_buffers(scene), std::vector<std::string>{"sky.params"});
    choose_technique("sky", "tables", scene.settings);
    EXPECT_GT(sky_buffers(scene).size(), 3u);
}

}  // namespace
}  // namespace voxilux
