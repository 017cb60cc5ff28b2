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
constexpr double kRounding = 5e-6;

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
        pixel.variance_of_mean += kRounding * kRounding * pixel.mean * pixel.mean;
        truth.pixels.push_back(pixel);
    }
    return truth;
}

Scene scene_of(const std::string& name, const char* technique = "paths") {
    Scene scene = load_scene(data_of(name + ".toml"));
    choose_technique("indirect", technique, scene.settings);
    return scene;
}

LightPicture render(const Scene& scene, std::uint32_t samples) {
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

constexpr double kFarOff = 4.0;  // standard deviations

// z of equal pictures: its root mean square is 1 but for the noise of variances, which are means of a few
// samples of nine pixels. In the maze few paths meet most of the light, and variances of pixels that have not
// met it are too small: its z is not normal at few samples.
struct TruthCase {
    std::string scene;
    std::uint32_t samples = 64;
    double max_rms = 1.05;
};

void PrintTo(const TruthCase& one, std::ostream* out) {
    *out << one.scene << '_' << one.samples;
}

void expect_truth(const Scene& scene, const TruthCase& one) {
    const LightPicture traced = render(scene, one.samples);
    const PictureZ z = test::light_z(traced, truth_of(one.scene));
    const glm::dvec3 off = mean_of(traced) / mean_of(truth_of(one.scene)) - 1.0;
    testing::Test::RecordProperty("rms", std::to_string(z.rms));
    testing::Test::RecordProperty("beyond_4", std::to_string(z.beyond_4));
    testing::Test::RecordProperty("z_of_mean", std::to_string(farthest(z.of_mean)));
    testing::Test::RecordProperty("mean_off", std::to_string(farthest(off)));
    EXPECT_GT(z.rms, 0.95);
    EXPECT_LT(z.rms, one.max_rms);
    EXPECT_LT(farthest(z.of_mean), kFarOff);
}

class PathsExternal : public testing::TestWithParam<TruthCase> {};

TEST_P(PathsExternal, picture_is_the_truth_within_its_noise) {
    SKIP_WITHOUT_SHARED_DATA();
    expect_truth(scene_of(GetParam().scene), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Gi, PathsExternal,
                         testing::Values(TruthCase{"courtyard"}, TruthCase{"room", 96, 1.1}, TruthCase{"pillars"},
                                         TruthCase{"maze", 96, 1.3}, TruthCase{"corner"}),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace voxilux
