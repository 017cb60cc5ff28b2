// Changes that must not change a picture, or only by as little as they shine: the light that each technique
// finds is a continuous function of the scene, and does not depend on how the scene is written down.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <string>

#include "formats/scene_toml.h"
#include "scene/scene_camera.h"
#include "scene/technique_choice.h"
#include "support/light_pictures.h"
#include "support/light_scenes.h"
#include "support/shared_data.h"

namespace voxilux {
namespace {

using test::LightPicture;

constexpr std::uint32_t kSamples = 48;

// As [technique] names it; "auto" leaves the choice to the plan.
struct Way {
    std::string effect;
    std::string technique;
};

void PrintTo(const Way& way, std::ostream* out) {
    *out << way.effect << '_' << way.technique;
}

const Way kAuto{"indirect", "auto"};
const Way kReference{"indirect", "reference"};
const Way kPhotons{"indirect", "photons"};
const Way kOcclusion{"ao", "brute"};

// A court of a floor, a wall and an emitter above them under sun and sky. `shift` moves all of it; `is_split`
// makes two models of the wall and two materials of the emitter; `is_permuted` gives materials other numbers
// and names.
struct Court {
    glm::ivec3 shift{0};
    bool is_split = false;
    bool is_permuted = false;
    float lamp = 6.0f;  // radiance; 0: a stone in its place
};

Scene court(const Court& made) {
    Scene scene;
    scene.settings.size = {32, 24};
    scene.settings.photons.count = 4096;
    scene.settings.photons.radius = 1.0;
    scene.sun = {.azimuth_deg = 215.0f, .elevation_deg = 40.0f, .angular_diameter_deg = 4.0f};
    scene.sky.radiance = {0.4f, 0.5f, 0.7f};
    std::array<std::uint16_t, 4> ids{};
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const std::size_t what = made.is_permuted ? ids.size() - 1 - i : i;
        const bool is_lamp = what >= 2 && made.lamp > 0.0f;
        ids[what] = test::add_material(
            scene, {.name = made.is_permuted ? fmt::format("other {}", i) : fmt::format("one {}", i),
                    .albedo = what == 1 ? glm::vec3(0.8f, 0.2f, 0.1f) : glm::vec3(0.6f),
                    .emission = glm::vec3(is_lamp ? made.lamp : 0.0f),
                    .surface = is_lamp ? Surface::emit : Surface::diffuse});
    }
    const auto box = [&](glm::ivec3 from, glm::ivec3 to, std::size_t what) {
        test::add_box(scene, from + made.shift, to + made.shift, ids[what]);
    };
    box({-8, -8, -1}, {8, 8, 0}, 0);
    box({3, -6, 0}, {4, made.is_split ? 0 : 6, 6}, 1);
    if (made.is_split) box({3, 0, 0}, {4, 6, 6}, 1);
    box({-2, 1, 4}, {-1, 2, 5}, 2);
    box({-1, 1, 4}, {0, 2, 5}, made.is_split ? 3 : 2);
    const glm::dvec3 shift(made.shift);
    scene.camera = test::camera_towards(glm::dvec3(-9, -13, 11) + shift, glm::dvec3(0, 0, 1) + shift, 45.0);
    return scene;
}

LightPicture render(Scene scene, const Way& way, std::uint32_t samples = kSamples) {
    choose_technique(way.effect, way.technique, scene.settings);
    const std::array blocks{1};
    return test::render_light(scene, {samples, blocks, {}}).front();
}

bool is_same(const LightPicture& a, const LightPicture& b) {
    return std::ranges::equal(a.pixels, b.pixels, {}, &test::TruthPixel::mean, &test::TruthPixel::mean);
}

// The largest difference of a pixel, radiance.
double farthest_apart(const LightPicture& a, const LightPicture& b) {
    double most = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const glm::dvec3 apart = glm::abs(a.pixels[i].mean - b.pixels[i].mean);
        most = std::max({most, apart.x, apart.y, apart.z});
    }
    return most;
}

// Of the means of two pictures, relative.
double mean_off(const LightPicture& a, const LightPicture& b) {
    glm::dvec3 of_a(0.0), of_b(0.0);
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        of_a += a.pixels[i].mean;
        of_b += b.pixels[i].mean;
    }
    const glm::dvec3 off = glm::abs(of_b / of_a - 1.0);
    return std::max({off.x, off.y, off.z});
}

class LightContinuity : public testing::TestWithParam<Way> {};

TEST_P(LightContinuity, faint_light_changes_the_picture_by_as_little) {
    const Way& way = GetParam();
    const LightPicture without = render(court({.lamp = 0.0f}), way);
    const LightPicture faint = render(court({.lamp = 1e-4f}), way);
    EXPECT_TRUE(test::is_equal_light(without, faint));
    // Photons of the sun differ where some photons start from the emitter.
    const double most = way.technique == "photons" ? 1.0 : 1e-3;
    EXPECT_LT(farthest_apart(without, faint), most);
    EXPECT_FALSE(test::is_equal_light(without, render(court({.lamp = 6.0f}), way))) << "negative control";
}

TEST_P(LightContinuity, light_in_two_parts_is_the_same_light) {
    const LightPicture whole = render(court({}), GetParam());
    EXPECT_TRUE(test::is_equal_light(whole, render(court({.is_split = true}), GetParam())));
    EXPECT_FALSE(test::is_equal_light(whole, render(court({.lamp = 7.5f}), GetParam())))
        << "negative control";
}

// Equal to the bit: other numbers and names of materials, and a shift by whole voxels.
TEST_P(LightContinuity, scene_written_otherwise_is_the_same_picture) {
    const LightPicture one = render(court({}), GetParam(), 8);
    EXPECT_TRUE(is_same(one, render(court({.is_permuted = true}), GetParam(), 8)));
    EXPECT_TRUE(is_same(one, render(court({.shift = {64, -128, 32}}), GetParam(), 8)));
    EXPECT_FALSE(is_same(one, render(court({.lamp = 6.01f}), GetParam(), 8))) << "negative control";
}

INSTANTIATE_TEST_SUITE_P(Ways, LightContinuity, testing::Values(kAuto, kReference, kPhotons, kOcclusion),
                         testing::PrintToStringParamName());

// Glass that neither refracts nor absorbs, around the wall: light of sun and sky goes through. (Behind glass,
// photons find no light of the sky, and occlusion takes the glass for a wall: the plan notes it.)
Scene glazed(float ior, float albedo) {
    Scene scene = court({.lamp = 0.0f});
    const std::uint16_t glass = test::add_glass(scene, ior, albedo);
    test::add_box(scene, {2, -7, 0}, {3, 7, 7}, glass);
    test::add_box(scene, {4, -7, 0}, {5, 7, 7}, glass);
    return scene;
}

TEST(LightContinuityOf, invisible_glass_is_invisible) {
    const LightPicture without = render(court({.lamp = 0.0f}), kAuto, 96);
    EXPECT_TRUE(test::is_equal_light(without, render(glazed(1.0f, 1.0f), kAuto, 96)));
    EXPECT_FALSE(test::is_equal_light(without, render(glazed(1.0f, 0.9f), kAuto, 96))) << "negative control";
}

Scene shared_model(const std::string& name, int frame = 0) {
    Scene scene =
        parse_scene(fmt::format("[render]\nsize = [32, 24]\n[[model]]\nfile = \"{}\"\nframe = {}\n",
                                (shared_data() / "data" / "faults" / (name + ".vox")).string(), frame),
                    "s.toml");
    scene.camera = camera_of(scene);
    return scene;
}

TEST(LightContinuityExternalNightly, faint_lamps_and_invisible_glass_do_not_show) {
    SKIP_WITHOUT_SHARED_DATA();
    const LightPicture off = render(shared_model("court_off"), kAuto);
    EXPECT_LT(farthest_apart(off, render(shared_model("court_on"), kAuto)), 1e-3);
    const LightPicture first = render(shared_model("anim_lamp"), kAuto);
    // The emitter has another colour than the stone in its place.
    for (const int frame : {1, 2, 3})
        EXPECT_LT(mean_off(first, render(shared_model("anim_lamp", frame), kAuto)), 0.01) << frame;
    Scene glazed_model = shared_model("glass_ior1");
    Scene bare_model = shared_model("glass_none");
    const LightPicture nearer = render(bare_model, kAuto, 128);
    bare_model.camera = glazed_model.camera;  // which frames the glass, too
    const LightPicture bare = render(bare_model, kAuto, 128);
    test::expect_equal_light(bare, render(glazed_model, kAuto, 128), "invisible_glass");
    EXPECT_FALSE(test::is_equal_light(bare, nearer)) << "negative control: each its own camera";
}

}  // namespace
}  // namespace voxilux
