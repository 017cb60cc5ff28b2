// Small renders of our scenes against pictures that were looked at when they were stored. VOXILUX_BLESS=1
// stores new ones: look at each before it is committed.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <ostream>

#include "estimators/flip.h"
#include "estimators/metrics.h"
#include "film/tonemap.h"
#include "formats/png.h"
#include "formats/scene_toml.h"
#include "scene/scene_camera.h"
#include "support/frame_fixture.h"

namespace voxilux {
namespace {

namespace fs = std::filesystem;

// Mean FLIP. Pictures of one device are equal to the last bit. Other devices may round square roots and
// divisions otherwise, which moves rays by some millionths of a voxel; moved ten times as far, they change
// the mean by 0.0001 at most. Another seed of the samples changes it by 0.0037 at least.
constexpr double kFlipThreshold = 0.001;

struct GoldenCase {
    std::string name;
    glm::ivec2 size;
};

void PrintTo(const GoldenCase& golden, std::ostream* out) {
    *out << golden.name;
}

const std::vector<GoldenCase>& cases() {
    static const std::vector<GoldenCase> all = {{"first_light", {80, 45}}, {"mixed", {64, 36}},
                                                {"spheres", {64, 36}},     {"night", {64, 36}},
                                                {"wall_corner", {48, 48}}, {"emitters", {64, 36}}};
    return all;
}

fs::path golden_file(const std::string& name) {
    return fs::path(VX_SOURCE_DIR) / "tests/device/image/golden" / (name + ".png");
}

Scene golden_scene(const GoldenCase& golden) {
    Scene scene = load_scene(fs::path(VX_SOURCE_DIR) / "scenes" / (golden.name + ".toml"));
    scene.settings.size = golden.size;
    scene.settings.spp = 32;
    return scene;
}

// As it would be in a PNG: tone mapped, 8-bit codes.
Image render_display(const Scene& scene) {
    return to_display(test::render_validated(scene).image, {}).image;
}

double mean_flip_of(const FlipResult& result, const Image& image) {
    return mean_flip(result, selected_pixels(image.width, image.height, {}));
}

// Writes the picture and its difference beside the test's binary, for people.
void write_failure(const std::string& name, const Image& got, const FlipResult& result) {
    const fs::path folder = VX_OUTPUT_DIR;
    Image difference{.width = got.width, .height = got.height};
    difference.channels["Y"].pixels = result.error;
    write_png(folder / (name + ".got.png"), got);
    write_png(folder / (name + ".flip.png"), difference);
    fmt::print("wrote {0}/{1}.got.png and {0}/{1}.flip.png\n", folder.string(), name);
}

class Golden : public testing::TestWithParam<GoldenCase> {};

TEST_P(Golden, render_looks_like_the_stored_picture) {
    const Image got = render_display(golden_scene(GetParam()));
    const fs::path file = golden_file(GetParam().name);
    if (std::getenv("VOXILUX_BLESS") != nullptr) {
        write_png(file, got);
        GTEST_SKIP() << "stored " << file.string() << ": look at it";
    }
    const Image want = read_png(file);
    ASSERT_EQ(got.width, want.width);
    ASSERT_EQ(got.height, want.height);
    const std::optional<FlipResult> result = flip(want, got);
    ASSERT_TRUE(result);
    const double error = mean_flip_of(*result, got);
    RecordProperty("flip", fmt::format("{:.6f}", error));
    EXPECT_LT(error, kFlipThreshold);
    if (HasFailure()) write_failure(GetParam().name, got, *result);
}

TEST_P(Golden, stored_picture_is_not_flat) {
    const Image want = read_png(golden_file(GetParam().name));
    const std::vector<float>& green = want.channels.at("G").pixels;
    const auto [low, high] = std::ranges::minmax_element(green);
    EXPECT_GT(*high - *low, 0.05f);
}

struct Perturbation {
    std::string name;
    void (*apply)(Scene&);
};

double flip_of(const GoldenCase& golden, const Perturbation& perturbation) {
    Scene scene = golden_scene(golden);
    scene.camera = camera_of(scene);
    perturbation.apply(scene);
    const Image got = render_display(scene);
    return mean_flip_of(flip(read_png(golden_file(golden.name)), got).value(), got);
}

// Each change is small, and each must be noticed.
TEST_P(Golden, perturbed_camera_albedo_and_seed_are_caught) {
    const std::vector<Perturbation> perturbations = {
        {"camera turned by a degree", [](Scene& scene) { scene.camera->yaw_deg += 1.0; }},
        {"albedo 5 % lower",
         [](Scene& scene) {
             for (Material& material : scene.materials)
                 material.albedo *= 0.95f;
         }},
        {"another seed", [](Scene& scene) { scene.settings.seed += 1; }},
    };
    for (const Perturbation& perturbation : perturbations)
        EXPECT_GT(flip_of(GetParam(), perturbation), 2.0 * kFlipThreshold) << perturbation.name;
}

TEST_P(Golden, camera_moved_by_a_hundred_thousandth_of_a_voxel_is_not) {
    const Perturbation rounding{"", [](Scene& scene) { scene.camera->position += glm::dvec3(1e-5); }};
    EXPECT_LT(flip_of(GetParam(), rounding), 0.5 * kFlipThreshold);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Golden, testing::ValuesIn(cases()),
                         [](const testing::TestParamInfo<GoldenCase>& golden) { return golden.param.name; });

}  // namespace
}  // namespace voxilux
