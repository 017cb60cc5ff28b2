// Pictures of paths against those of two independent path tracers (../shared/data/gi), and the solution of a
// corner by radiosity.

#include <cmath>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "formats/exr.h"
#include "formats/scene_toml.h"
#include "scene/technique_choice.h"
#include "support/light_pictures.h"
#include "support/shared_data.h"

namespace voxilux {
namespace {

using test::LightPicture;
using test::PictureZ;

// Relative, of the plain sky, which has no noise: the rounding of the files.
constexpr double kFileRounding = 5e-6;

std::filesystem::path data_of(const std::string& name) {
    return shared_data() / "data" / "gi" / name;
}

LightPicture truth_of(const std::string& name) {
    const Image mean = read_exr(data_of(name + ".exr"));
    const Image variance = read_exr(data_of(name + ".variance_of_mean.exr"));
    const auto means = colour_planes(mean).value();
    const auto variances = colour_planes(variance).value();
    LightPicture truth{{mean.width, mean.height}, {}};
    for (std::size_t i = 0; i < means[0].size(); ++i) {
        test::TruthPixel pixel{glm::dvec3(means[0][i], means[1][i], means[2][i]),
                               glm::dvec3(variances[0][i], variances[1][i], variances[2][i])};
        pixel.variance_of_mean += kFileRounding * kFileRounding * pixel.mean * pixel.mean;
        truth.pixels.push_back(pixel);
    }
    return truth;
}

Scene scene_of(const std::string& name, const char* technique = "paths") {
    Scene scene = load_scene(data_of(name + ".toml"));
    choose_technique("indirect", technique, scene.settings);
    return scene;
}

LightPicture render_white(const Scene& scene, std::uint32_t samples) {
    const std::array blocks{1};
    return test::render_light(scene, {samples, blocks, {}}).front();
}

glm::dvec3 mean_of(const LightPicture& picture) {
    glm::dvec3 sum(0.0);
    for (const test::TruthPixel& pixel : picture.pixels)
        sum += pixel.mean;
    return sum / static_cast<double>(picture.pixels.size());
}

double farthest(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

constexpr double kFarPixel = 4.0;  // standard deviations
// z of equal pictures has a root mean square of 1, but for the noise of the variances.
constexpr double kMinRms = 0.95;
constexpr double kMaxRms = 1.05;

struct TruthCase {
    std::string scene;
    std::uint32_t samples = 64;
    double min_rms = kMinRms;
};

void PrintTo(const TruthCase& one, std::ostream* out) {
    *out << one.scene << '_' << one.samples;
}

struct Distance {
    PictureZ z;
    double of_mean = 0.0;  // relative
};

Distance distance_of(const LightPicture& traced, const LightPicture& truth) {
    const Distance distance{test::light_z(traced, truth), farthest(mean_of(traced) / mean_of(truth) - 1.0)};
    testing::Test::RecordProperty("rms", std::to_string(distance.z.rms));
    testing::Test::RecordProperty("beyond_4", std::to_string(distance.z.beyond_4));
    testing::Test::RecordProperty("z_of_mean", std::to_string(farthest(distance.z.of_mean)));
    testing::Test::RecordProperty("mean_off", std::to_string(distance.of_mean));
    return distance;
}

bool agrees(const PictureZ& z, double min_rms = kMinRms) {
    return z.rms > min_rms && z.rms < kMaxRms && farthest(z.of_mean) < kFarPixel;
}

void expect_truth(const Scene& scene, const TruthCase& one) {
    const PictureZ z = distance_of(render_white(scene, one.samples), truth_of(one.scene)).z;
    EXPECT_TRUE(agrees(z, one.min_rms)) << z.rms << ' ' << farthest(z.of_mean);
}

class PathsExternal : public testing::TestWithParam<TruthCase> {};

TEST_P(PathsExternal, picture_is_the_truth_within_its_noise) {
    SKIP_WITHOUT_SHARED_DATA();
    expect_truth(scene_of(GetParam().scene), GetParam());
}

// In the room and the maze few paths carry most of the light. With fewer samples, pixels that have met none
// of them have too small a variance. Smoothing gives pixels beside one that an emitter partly fills too large
// a variance.
INSTANTIATE_TEST_SUITE_P(Gi, PathsExternal,
                         testing::Values(TruthCase{"courtyard"}, TruthCase{"room", 96}, TruthCase{"pillars"},
                                         TruthCase{"maze", 96, 0.7}, TruthCase{"corner"}),
                         testing::PrintToStringParamName());

// The means over a picture, from enough samples to resolve a thousandth.
class PathsNightlyExternal : public testing::TestWithParam<TruthCase> {};

TEST_P(PathsNightlyExternal, mean_is_the_truth_within_a_thousandth) {
    SKIP_WITHOUT_SHARED_DATA();
    const Scene scene = scene_of(GetParam().scene);
    const Distance distance =
        distance_of(render_white(scene, GetParam().samples), truth_of(GetParam().scene));
    EXPECT_TRUE(agrees(distance.z)) << distance.z.rms << ' ' << farthest(distance.z.of_mean);
    EXPECT_LT(distance.of_mean, 0.001);
}

INSTANTIATE_TEST_SUITE_P(Gi, PathsNightlyExternal,
                         testing::Values(TruthCase{"courtyard", 512}, TruthCase{"pillars", 256},
                                         TruthCase{"room", 4096}),
                         testing::PrintToStringParamName());

TEST(ReferenceExternal, plain_paths_give_the_same_picture) {
    SKIP_WITHOUT_SHARED_DATA();
    expect_truth(scene_of("courtyard", "reference"), {"courtyard"});
    expect_truth(scene_of("pillars", "reference"), {"pillars"});
}

// A density that is off by 1 % scales what each reflection sends on by as much.
TEST(PathsExternal, reflection_that_is_a_hundredth_too_weak_is_caught) {
    SKIP_WITHOUT_SHARED_DATA();
    for (const char* name : {"courtyard", "pillars", "corner"}) {
        Scene scene = scene_of(name);
        for (Material& material : scene.materials)
            material.albedo *= 0.99f;
        EXPECT_FALSE(agrees(distance_of(render_white(scene, 64), truth_of(name)).z)) << name;
    }
}

constexpr int kCornerBlock = 8;  // pixels: a single one gets too few reflections to estimate its variance

// Below 0 where a pixel of the block shows something other than the two faces: radiosity gives -1 there.
glm::dvec3 mean_of_block(const std::array<std::span<const float>, 3>& planes, int width, glm::ivec2 block) {
    glm::dvec3 sum(0.0);
    for (int y = 0; y < kCornerBlock; ++y) {
        for (int x = 0; x < kCornerBlock; ++x) {
            const glm::ivec2 at = kCornerBlock * block + glm::ivec2(x, y);
            const auto i = static_cast<std::size_t>(at.y * width + at.x);
            if (planes[0][i] < 0.0f) return glm::dvec3(-1.0);
            sum += glm::dvec3(planes[0][i], planes[1][i], planes[2][i]);
        }
    }
    return sum / static_cast<double>(kCornerBlock * kCornerBlock);
}

// The error of the solution itself is below 1e-4.
TEST(PathsExternal, p6_corner_is_the_solution_by_radiosity) {
    SKIP_WITHOUT_SHARED_DATA();
    const Image solution = read_exr(data_of("corner.radiosity.exr"));
    const auto planes = colour_planes(solution).value();
    const std::array blocks{kCornerBlock};
    const LightPicture picture = test::render_light(scene_of("corner"), {64, blocks, {}}).front();
    std::vector<test::TruthPixel> traced, expected;
    for (int y = 0; y < picture.size.y; ++y) {
        for (int x = 0; x < picture.size.x; ++x) {
            const glm::dvec3 radiance = mean_of_block(planes, solution.width, {x, y});
            if (radiance.x < 0.0) continue;
            traced.push_back(picture.at({x, y}));
            expected.push_back({radiance, 1e-8 * radiance * radiance});
        }
    }
    ASSERT_GT(traced.size(), 80u);
    const PictureZ z = test::picture_z(traced, expected);
    testing::Test::RecordProperty("rms", std::to_string(z.rms));
    EXPECT_LT(z.rms, 1.2);
    EXPECT_LT(farthest(z.of_mean), kFarPixel);
}

}  // namespace
}  // namespace voxilux
