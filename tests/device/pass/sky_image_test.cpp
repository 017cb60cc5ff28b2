// An image of the sky: what surfaces receive from it against closed forms, by each technique, and what is
// seen. All images have the same size where they can, because each other size is another shader to compile.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "frame/footprint.h"
#include "frame/frame.h"
#include "scene/sky_image.h"
#include "scene/technique_choice.h"
#include "support/frame_fixture.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

using glm::dvec3;
using glm::vec3;

constexpr double kPi = std::numbers::pi;
constexpr double kSkySigmas = 4.0;  // standard errors of a mean: 1 in 16,000 by chance, and seeds are fixed
constexpr glm::ivec2 kSkySize{16, 8};
constexpr std::size_t kSpot = 2 * 16 + 5;  // row 2: 45 to 67.5 degrees from the zenith

Sky image_of(vec3 radiance, glm::ivec2 size = kSkySize) {
    Sky sky{.model = SkyModel::image};
    sky.image = {size, std::vector<vec3>(static_cast<std::size_t>(size.x * size.y), radiance)};
    return sky;
}

Sky spot_sky(vec3 radiance) {
    Sky sky = image_of(vec3(0.0f));
    sky.image.texels[kSpot] = radiance;
    return sky;
}

// What an open floor of albedo 1 shows under it: irradiance / pi, the integral of cos over the texel.
dvec3 open_floor_light(vec3 radiance) {
    const double top = std::sin(2.0 * kPi / 8.0), bottom = std::sin(3.0 * kPi / 8.0);
    return dvec3(radiance) * (2.0 * kPi / 16.0 * 0.5 * (bottom * bottom - top * top) / kPi);
}

Scene floor_under(const Sky& sky) {
    Scene scene = test::white_scene();
    test::add_box(scene, {-40, -40, -1}, {40, 40, 0});
    scene.sky = sky;
    scene.sun.on = false;
    scene.settings.size = {32, 32};
    scene.settings.sequence = Sequence::white;
    scene.camera = test::camera_down({0.0, 0.0, 20.0}, 40.0);
    return scene;
}

Scene by_paths(Scene scene) {
    choose_technique("indirect", "paths", scene.settings);
    return scene;
}

struct Light {
    dvec3 mean{0.0};
    dvec3 error{0.0};
};

// Of all pixels of some samples, which are independent with white noise.
Light light_of(test::FrameFixture& fixture, std::uint32_t samples) {
    dvec3 sum(0.0), squares(0.0);
    double count = 0.0;
    for (std::uint32_t sample = 0; sample < samples; ++sample) {
        for (const vec3& color : fixture.render(sample).color) {
            sum += dvec3(color);
            squares += dvec3(color) * dvec3(color);
            count += 1.0;
        }
    }
    const dvec3 mean = sum / count;
    return {mean, glm::sqrt(glm::max(squares / count - mean * mean, dvec3(0.0)) / count)};
}

Light light_of(const Scene& scene, std::uint32_t samples, const PlanRequest& request = {}) {
    test::FrameFixture fixture(scene, request);
    return light_of(fixture, samples);
}

constexpr double kLightRounding = 1e-4;  // relative: of the device's sines and of densities in floats

bool is_light(const Light& found, const dvec3& expected) {
    const dvec3 tolerance = kSkySigmas * found.error + kLightRounding * expected;
    return glm::all(glm::lessThanEqual(glm::abs(found.mean - expected), tolerance));
}

TEST(SkyImageLight, floor_under_one_bright_texel_receives_its_closed_form) {
    const vec3 radiance(40.0f, 20.0f, 10.0f);
    const dvec3 expected = open_floor_light(radiance);
    for (const bool paths : {true, false}) {
        const Scene floor = floor_under(spot_sky(radiance));
        const Light found = light_of(paths ? by_paths(floor) : floor, 16);
        EXPECT_TRUE(is_light(found, expected)) << found.mean.x << " for " << expected.x << " paths " << paths;
        EXPECT_FALSE(is_light(found, 1.05 * expected)) << "the test tells nothing";
        EXPECT_LT(found.error.x, 0.02 * expected.x);
    }
    const PlanRequest without_ao{.effects = {.switches = {{Effect::ao, Switch::off}}}};
    const Light faces = light_of(floor_under(spot_sky(radiance)), 1, without_ao);
    EXPECT_TRUE(is_light(faces, expected));
    EXPECT_EQ(faces.error.x, 0.0);
}

TEST(SkyImageLight, plain_paths_find_the_same_by_chance) {
    Scene scene = floor_under(spot_sky(vec3(40.0f)));
    choose_technique("indirect", "reference", scene.settings);
    const Light found = light_of(scene, 16);
    EXPECT_TRUE(is_light(found, open_floor_light(vec3(40.0f))));
    EXPECT_GT(found.error.x, 4.0 * light_of(by_paths(floor_under(spot_sky(vec3(40.0f)))), 16).error.x);
}

TEST(SkyImageLight, density_that_is_off_by_one_percent_is_caught) {
    const Sky sky = spot_sky(vec3(40.0f));
    test::FrameFixture fixture(by_paths(floor_under(sky)), PlanRequest{});
    SkySampler sampler = sky_sampler(sky);
    for (gpu::vec4& texel : sampler.texels)
        texel.w *= 1.01f;
    Recording recording;
    const std::string texels =
        declare<gpu::vec4>(recording, "sky.texels", sampler.texels.size(), Lifetime::persistent);
    recording.upload(texels, std::as_bytes(std::span(sampler.texels)));
    (void)test_executor().run(recording);
    EXPECT_FALSE(is_light(light_of(fixture, 16), open_floor_light(vec3(40.0f))));
}

// Niches of albedo 1 under a sky of 1 everywhere: whatever finds light where, radiance is 1.
TEST(SkyImageLight, furnace_is_white_under_a_constant_image) {
    for (const glm::ivec2 size : {kSkySize, glm::ivec2(1, 1)}) {
        Scene scene = by_paths(floor_under(image_of(vec3(1.0f), size)));
        for (const int x : {-5, -2, 2, 4})
            test::add_box(scene, {x, -4, 0}, {x + 1, 4, 5});
        scene.camera = test::camera_towards({-12, -15, 14}, {0, 0, 1}, 45.0);
        const Light found = light_of(scene, 32);
        EXPECT_TRUE(is_light(found, dvec3(1.0))) << found.mean.x << ' ' << found.error.x;
        EXPECT_FALSE(is_light(found, dvec3(1.02))) << "the test tells nothing";
    }
}

// A grey court, so that light between surfaces counts, under an image and under the constant sky.
TEST(SkyImageLight, constant_image_equals_the_constant_sky) {
    std::array<Light, 2> found;
    for (const bool is_image : {false, true}) {
        Scene scene = by_paths(floor_under(image_of(vec3(0.5f, 1.0f, 2.0f))));
        if (!is_image) scene.sky = Sky{.radiance = {0.5f, 1.0f, 2.0f}};
        scene.materials[0].albedo = vec3(0.6f);
        test::add_box(scene, {-6, -6, 0}, {-5, 6, 8});
        test::add_box(scene, {5, -6, 0}, {6, 6, 8});
        found[is_image ? 1 : 0] = light_of(scene, 16);
    }
    for (int c = 0; c < 3; ++c) {
        const double error = std::hypot(found[0].error[c], found[1].error[c]);
        EXPECT_NEAR(found[0].mean[c], found[1].mean[c], kSkySigmas * error);
        EXPECT_LT(error, 0.01 * found[0].mean[c]) << "the test tells nothing";
    }
}

// A wall shades the floor on one side.
Scene wall_under(const Sky& sky, bool is_turned) {
    Scene scene = by_paths(floor_under(sky));
    if (is_turned)
        test::add_box(scene, {-30, 8, 0}, {30, 9, 12});  // the other one, a quarter turn later
    else
        test::add_box(scene, {8, -30, 0}, {9, 30, 12});
    return scene;
}

TEST(SkyImageLight, rotated_image_over_a_rotated_scene_is_the_same) {
    Sky sky = image_of(vec3(0.02f));
    sky.image.texels[4 * 16 - 16 + 8] = vec3(50.0f);  // low, just right of +x: behind the wall
    const Light straight = light_of(wall_under(sky, false), 8);
    sky.rotation_deg = 90.0f;
    const Light turned = light_of(wall_under(sky, true), 8), wrong = light_of(wall_under(sky, false), 8);
    const double error = std::hypot(straight.error.x, turned.error.x);
    EXPECT_NEAR(straight.mean.x, turned.mean.x, kSkySigmas * error);
    EXPECT_GT(std::abs(straight.mean.x - wrong.mean.x), 10.0 * error);
}

TEST(SkyImageSeen, panorama_of_the_sky_is_its_image) {
    Sky sky = image_of(vec3(0.0f));
    for (std::size_t i = 0; i < sky.image.texels.size(); ++i)
        sky.image.texels[i] = vec3(static_cast<float>(i), 1.0f, 0.5f);
    for (const int columns : {0, 4}) {
        sky.rotation_deg = 360.0f * static_cast<float>(columns) / 16.0f;
        Scene scene = test::white_scene();
        scene.sky = sky;
        scene.settings.size = kSkySize;
        scene.camera = Camera{.projection = Projection::equirectangular};
        const std::vector<vec3> seen = test::render_first_sample(scene).color;
        for (std::size_t i = 0; i < seen.size(); ++i)
            EXPECT_EQ(seen[i], sky.image.texels[i / 16 * 16 + (i + static_cast<std::size_t>(columns)) % 16])
                << i;
    }
}

// The worst that an image can hold: everything comes from one texel, a million times as bright as the rest.
TEST(SkyImageLight, claim_of_the_error_stays_true_under_one_texel_of_a_million) {
    Sky sky = spot_sky(vec3(kMaxRadiance));
    Scene scene = floor_under(sky);
    scene.settings.sequence = Sequence::sobol;
    scene.settings.spp = 32;
    const RenderOutcome outcome = test::render_validated(
        by_paths(scene), {.plan = {.effects = {.wants_aov = true}}, .keeps_film = true});
    const dvec3 expected = open_floor_light(vec3(kMaxRadiance));
    double sum = 0.0;
    const std::vector<float>& red = outcome.image.channels.at("R").pixels;
    for (const float value : red)
        sum += std::pow((double{value} - expected.x) / expected.x, 2.0);
    const double error = std::sqrt(sum / static_cast<double>(red.size()));
    const ErrorEstimate claim = claimed_error_of(*outcome.film, outcome.statistics.faults);
    EXPECT_LE(error, claim.high);
    EXPECT_GE(error, claim.low);
    EXPECT_GT(error, 0.0);
}

TEST(SkyImageBuild, black_image_and_other_skies_leave_nothing_of_it) {
    const auto parts = [](const Scene& scene) {
        const Footprint needs = footprint(test::FrameFixture(scene, PlanRequest{}).plan(), record_frame);
        const auto is_sky = [](const std::string& name) { return name.starts_with("sky."); };
        return std::ranges::count_if(needs.buffers, is_sky, &PlannedBuffer::buffer) +
               std::ranges::count_if(needs.passes, is_sky, &PlannedPass::label);
    };
    EXPECT_EQ(parts(by_paths(floor_under(image_of(vec3(1.0f))))), 4);  // texels, table, light, its pass
    EXPECT_EQ(parts(by_paths(floor_under(image_of(vec3(0.0f))))), 0);
    EXPECT_EQ(parts(by_paths(floor_under(Sky{}))), 0);
}

}  // namespace
}  // namespace voxilux
