// Pictures of photon mapping against the tests' own path tracer, which shares no code with the shaders. The
// radius is so small that the blur of the discs is below the noise.

#include <cmath>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "formats/scene_toml.h"
#include "support/light_pictures.h"

namespace voxilux {
namespace {

using test::LightPicture;
using test::PictureZ;

struct LightCase {
    std::string scene;
    glm::ivec2 size{32, 32};  // blocks of the fine pictures
    int block = 2;            // their width in pixels
    int coarse = 4;           // fine blocks in a coarse one, on an edge
    std::uint32_t iterations = 64;
    std::uint32_t photons = 16384;
    double radius = 0.5;
    int truth_spp = 256;
};

void PrintTo(const LightCase& one, std::ostream* out) {
    *out << one.scene;
}

// A change to the scene that is rendered, but not to the scene of the truth.
using Change = void (*)(Scene&);
void no_change(Scene&) {}

struct LightZ {
    PictureZ fine;
    PictureZ coarse;
    double whole = 0.0;  // of the mean of the picture, the channel that is farthest off
};

LightZ compare(const LightCase& c, Change change = no_change) {
    Scene scene = load_scene(std::filesystem::path(VX_SOURCE_DIR) / "scenes" / (c.scene + ".toml"),
                             {.overrides = {"render.size=[" + std::to_string(c.size.x * c.block) + ", " +
                                            std::to_string(c.size.y * c.block) + "]"}});
    scene.settings.photons.count = c.photons;
    scene.settings.photons.radius = c.radius;
    scene.settings.photons.alpha = 1.0;
    const LightPicture truth =
        test::truth_picture(test::truth_world(scene), {.size = c.size, .spp = c.truth_spp, .seed = 11});
    change(scene);
    const std::array blocks{c.block, c.block * c.coarse, c.block * c.size.x};
    const std::vector<LightPicture> ours = test::render_light(scene, {c.iterations, blocks, {}});
    LightZ z{test::light_z(ours[0], truth), test::light_z(ours[1], test::coarser(truth, c.coarse)), 0.0};
    const PictureZ whole = test::light_z(ours[2], test::coarser(truth, c.size.x));
    z.whole = std::max({std::abs(whole.of_mean.x), std::abs(whole.of_mean.y), std::abs(whole.of_mean.z)});
    testing::Test::RecordProperty("fine", std::to_string(z.fine.rms));
    testing::Test::RecordProperty("fine_beyond_4", std::to_string(z.fine.beyond_4));
    testing::Test::RecordProperty("coarse", std::to_string(z.coarse.rms));
    testing::Test::RecordProperty("whole", std::to_string(z.whole));
    return z;
}

const LightCase kCases[] = {
    {.scene = "cornell"},
    {.scene = "cornell_small_light", .radius = 0.5},
    {.scene = "large"},
    {.scene = "mirror"},
    {.scene = "surgery", .size = {16, 16}},
    {.scene = "random", .size = {16, 16}, .iterations = 32, .truth_spp = 128},
    {.scene = "glass_in_glass"},
    {.scene = "glass_block", .radius = 0.1},
};

class LightTruth : public testing::TestWithParam<LightCase> {};

// Where caustics are rare (mirror, cornell_small_light) few paths of the truth find them, so its variances
// are too small, and the fine pictures are up to 1.2 deviations apart.
constexpr double kMaxFine = 1.3;
constexpr double kMaxCoarse = 1.25;
constexpr double kMaxWhole = 4.0;

bool agrees(const LightZ& z) {
    return z.fine.rms < kMaxFine && z.coarse.rms < kMaxCoarse && z.whole < kMaxWhole;
}

TEST_P(LightTruth, picture_agrees_with_paths) {
    const LightZ z = compare(GetParam());
    EXPECT_TRUE(agrees(z)) << z.fine.rms << ' ' << z.coarse.rms << ' ' << z.whole;
}

INSTANTIATE_TEST_SUITE_P(Scenes, LightTruth, testing::ValuesIn(kCases),
                         [](const auto& tested) { return tested.param.scene; });

TEST(LightTruthTwin, wall_that_is_a_twentieth_darker_is_caught) {
    const LightZ z = compare(kCases[0], [](Scene& scene) {
        for (Material& m : scene.materials)
            if (m.name == "left") m.albedo *= 0.95f;
    });
    EXPECT_FALSE(agrees(z)) << z.coarse.rms << ' ' << z.whole;
}

TEST(LightTruthTwin, emitter_moved_by_one_unit_is_caught) {
    const LightZ z = compare(kCases[0], [](Scene& scene) { scene.spheres.at(7).centre.x += 1.0; });
    EXPECT_FALSE(agrees(z)) << z.coarse.rms << ' ' << z.whole;
}

}  // namespace
}  // namespace voxilux
