// The passes of an atmosphere: its tables against the same functions as C++, the light of open surfaces
// against the integral of the tables, and what is seen.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "frame/footprint.h"
#include "frame/frame.h"
#include "passes/sky/sky.h"
#include "scene/atmosphere.h"
#include "scene/technique_choice.h"
#include "shared/sampling.h"
#include "support/frame_fixture.h"
#include "support/sky_model.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

using glm::vec3;

// Rounding of the device's exp, atan, sin and pow (up to 1e-4 of arguments), through the exponents of long
// columns.
constexpr float kDeviceError = 5e-3f;
// Standard errors of a mean: 1 in 16,000 by chance, and the seeds are fixed.
constexpr double kSigmas = 4.0;

Scene open_floor(float sun_elevation_deg) {
    Scene scene = test::white_scene();
    test::add_box(scene, {-40, -40, -1}, {40, 40, 0});
    scene.sky.model = SkyModel::atmosphere;
    scene.sun = {.azimuth_deg = 30.0f, .elevation_deg = sun_elevation_deg, .irradiance = vec3(1.0f)};
    scene.settings.size = {32, 32};
    scene.camera = test::camera_down({0.0, 0.0, 20.0}, 40.0);
    return scene;
}

test::ScatterTable scatter_of(const Scene& scene) {
    return test::scatter_table(sky_params(scene).air);
}

// Values may differ by a fraction of themselves, or of the largest of all where they are almost zero.
void expect_near(std::span<const vec3> found, std::span<const vec3> expected) {
    ASSERT_EQ(found.size(), expected.size());
    float largest = 0.0f;
    for (const vec3& value : expected)
        largest = std::max({largest, value.x, value.y, value.z});
    ASSERT_GT(largest, 0.0f);
    for (std::size_t i = 0; i < found.size(); ++i) {
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(found[i][c], expected[i][c], kDeviceError * (expected[i][c] + 1e-4f * largest)) << i;
    }
}

vec3 face_light(const std::vector<vec3>& view, const gpu::SkyParams& sky, gpu::uint face) {
    vec3 sum(0.0f);
    for (gpu::uint i = 0; i < gpu::kFaceRays; ++i) {
        const gpu::FaceRay ray = gpu::face_ray(sky, i);
        sum += std::max(glm::dot(ray.direction, gpu::face_normal(face)), 0.0f) * ray.weight *
               gpu::sky_radiance(view, sky, ray.direction);
    }
    return sum * gpu::kInversePi;
}

TEST(SkyBuild, tables_equal_the_shared_functions) {
    for (const float sun : {-5.0f, 0.5f, 60.0f}) {
        const Scene scene = open_floor(sun);
        const test::FrameFixture fixture(scene);
        Recording recording;
        record_sky_build(fixture.plan(), scene, recording);
        recording.readback("sky.view");
        recording.readback("sky.shares");
        const RunResult result = test_executor().run(recording);
        const gpu::SkyParams sky = sky_params(scene);
        const std::vector<vec3> view = test::view_table(scatter_of(scene), sky);
        expect_near(values_of<vec3>(result, "sky.view"), view);
        const std::vector<float> found = values_of<float>(result, "sky.shares");
        const std::vector<float> shares = test::sky_shares(view, sky);
        ASSERT_EQ(found.size(), shares.size());
        for (std::size_t i = 0; i < shares.size(); ++i)
            ASSERT_NEAR(found[i], shares[i], kDeviceError) << i;
    }
}

struct Mean {
    glm::dvec3 mean{0.0};
    glm::dvec3 error{0.0};
};

// Of the values of many pixels and samples, which are independent with white noise.
class LightMean {
  public:
    void add(std::span<const vec3> values) {
        for (const vec3& value : values) {
            sum_ += glm::dvec3(value);
            squares_ += glm::dvec3(value) * glm::dvec3(value);
            count_ += 1.0;
        }
    }
    [[nodiscard]] Mean mean() const {
        const glm::dvec3 mean = sum_ / count_;
        return {mean, glm::sqrt((squares_ / count_ - mean * mean) / count_)};
    }

  private:
    glm::dvec3 sum_{0.0}, squares_{0.0};
    double count_ = 0.0;
};

// The light of the floor over many samples.
Mean mean_light(const Scene& scene, std::uint32_t samples) {
    test::FrameFixture fixture(scene);
    LightMean light;
    for (std::uint32_t sample = 0; sample < samples; ++sample)
        light.add(fixture.render(sample).sky);
    return light.mean();
}

TEST(SkyTrace, open_floor_receives_the_integral_of_the_sky) {
    for (const float sun : {-5.0f, -1.0f, 0.5f, 2.0f, 10.0f, 45.0f, 89.0f}) {
        Scene scene = open_floor(sun);
        scene.settings.sequence = Sequence::white;
        const gpu::SkyParams sky = sky_params(scene);
        const vec3 expected = face_light(test::view_table(scatter_of(scene), sky), sky, 5);
        const Mean found = mean_light(scene, 8);
        for (int c = 0; c < 3; ++c) {
            // 0.2 %: of the midpoints of the integral.
            EXPECT_NEAR(found.mean[c], double{expected[c]},
                        kSigmas * found.error[c] + 2e-3 * double{expected[c]})
                << sun << " colour " << c;
            EXPECT_LT(found.error[c], 0.05 * found.mean[c]) << "the test tells nothing";
        }
    }
}

// A convex floor sends no light to itself, so its paths find the light of the sky and nothing else.
TEST(SkyPaths, open_floor_receives_the_integral_of_the_sky) {
    Scene scene = open_floor(10.0f);
    scene.settings.sequence = Sequence::white;
    choose_technique("indirect", "paths", scene.settings);
    const PlanRequest request{.effects = {.switches = {{Effect::sun, Switch::off}}}};
    const gpu::SkyParams sky = sky_params(scene);
    const vec3 expected = face_light(test::view_table(scatter_of(scene), sky), sky, 5);
    test::FrameFixture fixture(scene, request);
    ASSERT_TRUE(fixture.plan().paths.runs());
    LightMean light;
    for (std::uint32_t sample = 0; sample < 16; ++sample)
        light.add(fixture.render(sample).color);
    const Mean found = light.mean();
    for (int c = 0; c < 3; ++c) {
        const double tolerance = kSigmas * found.error[c] + 2e-3 * double{expected[c]};
        EXPECT_NEAR(found.mean[c], double{expected[c]}, tolerance) << "colour " << c;
        EXPECT_GT(std::abs(found.mean[c] - 1.2 * double{expected[c]}), tolerance) << "the test tells nothing";
    }
}

TEST(SkyBuild, makes_what_the_frame_reads_and_no_more) {
    const Scene scene = open_floor(20.0f);
    const auto has = [](const Scene& of, const PlanRequest& request, const char* buffer) {
        const Footprint needs = footprint(test::FrameFixture(of, request).plan());
        return std::ranges::any_of(needs.buffers, [&](const PlannedBuffer& b) { return b.buffer == buffer; });
    };
    EXPECT_TRUE(has(scene, {}, "sky.shares"));
    EXPECT_FALSE(has(scene, {}, "sky.faces"));
    const PlanRequest without_ao{.effects = {.switches = {{Effect::ao, Switch::off}}}};
    EXPECT_FALSE(has(scene, without_ao, "sky.shares"));
    EXPECT_TRUE(has(scene, without_ao, "sky.faces"));
}

TEST(SkyResolve, all_of_the_sky_is_what_rays_find_on_an_open_floor) {
    Scene scene = open_floor(20.0f);
    const gpu::SkyParams sky = sky_params(scene);
    const vec3 expected = face_light(test::view_table(scatter_of(scene), sky), sky, 5);
    PlanRequest request{.effects = {.switches = {{Effect::ao, Switch::off}}}};
    test::FrameFixture fixture(scene, request);
    for (const vec3& light : fixture.render(0).sky) {
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(light[c], expected[c], kDeviceError * expected[c]);
    }
}

TEST(SkySeen, camera_sees_the_table_and_the_disc_of_the_sun) {
    Scene scene = open_floor(20.0f);
    scene.settings.size = {4, 4};
    const gpu::SkyParams sky = sky_params(scene);
    const std::vector<vec3> view = test::view_table(scatter_of(scene), sky);
    for (const glm::dvec2 away : {glm::dvec2(0.0, 0.0), {0.1, 0.0}, {3.0, 0.0}, {90.0, 40.0}, {180.0, 0.0}}) {
        scene.camera = Camera{.position = {0.0, 0.0, 5.0},
                              .yaw_deg = 30.0 + away.x,
                              .pitch_deg = 20.0 + away.y,
                              .fov_y_deg = 0.001};
        const test::FramePlanes planes = test::render_first_sample(scene);
        const vec3 direction = test::direction_of(30.0 + away.x, 20.0 + away.y);
        const vec3 expected =
            gpu::sky_radiance(view, sky, direction) + gpu::sun_disc_radiance(sky, direction);
        for (std::size_t i = 0; i < planes.sky.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                ASSERT_NEAR(planes.sky[i][c], expected[c], kDeviceError * expected[c]) << away.x;
                ASSERT_EQ(planes.color[i][c], planes.sky[i][c]);
            }
        }
    }
}

TEST(SkyBuild, nothing_of_it_is_in_a_scene_with_another_sky_or_none) {
    Scene scene = open_floor(20.0f);
    const auto parts_of_sky = [&] {
        const test::FrameFixture fixture(scene);
        const Footprint needs = footprint(fixture.plan(), record_frame);
        const auto is_sky = [](const std::string& name) { return name.starts_with("sky."); };
        return std::ranges::count_if(needs.buffers, is_sky, &PlannedBuffer::buffer) +
               std::ranges::count_if(needs.passes, is_sky, &PlannedPass::label);
    };
    EXPECT_GT(parts_of_sky(), 5);
    scene.sun.on = false;  // no light to scatter
    EXPECT_EQ(parts_of_sky(), 0);
    scene.sun.on = true;
    scene.sky.model = SkyModel::constant;
    EXPECT_EQ(parts_of_sky(), 0);
}

TEST(SkyBuild, tables_take_less_than_2_MiB) {
    const test::FrameFixture fixture(open_floor(20.0f));
    std::uint64_t bytes = 0;
    for (const PlannedBuffer& planned : footprint(fixture.plan(), record_frame).buffers)
        bytes += planned.buffer.starts_with("sky.") && planned.buffer != "sky.light" ? planned.bytes : 0;
    EXPECT_GT(bytes, 0u);
    EXPECT_LE(bytes, std::uint64_t{2} << 20);
}

TEST(Sunlight, surfaces_receive_what_the_air_lets_through) {
    Scene scene = open_floor(10.0f);
    const vec3 light = sunlight(scene);
    EXPECT_NEAR(light.x * scene.sun.direction().z, 0.1238f, 0.002f);  // of sky_truth on the ground
    EXPECT_LT(light.z, 0.5f * light.x);
    scene.sun.elevation_deg = -0.1f;  // the planet hides more than half of the disc
    EXPECT_GT(sunlight(scene).x, 0.0f);
    scene.sun.elevation_deg = -2.0f;
    EXPECT_EQ(sunlight(scene), vec3(0.0f));
    scene.sky.altitude_m = 20000.0f;  // the horizon is 4.5 degrees lower
    EXPECT_GT(sunlight(scene).x, 0.01f);
}

}  // namespace
}  // namespace voxilux
