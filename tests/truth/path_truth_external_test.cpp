// The tests' own path tracer against pictures by other path tracers.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "formats/exr.h"
#include "formats/scene_toml.h"
#include "support/path_truth.h"
#include "support/shared_data.h"

namespace voxilux {
namespace {

using test::PictureZ;
using test::TruthPixel;
using test::TruthRequest;

// The variance of a reference pixel over that of one path of ours. cornell_256 is the mean of two pictures,
// of 2176 and of 1536 paths a pixel; surgery_512x384 has 1536.
constexpr double kCornellVariance = 0.25 * (1.0 / 2176.0 + 1.0 / 1536.0);
constexpr double kSurgeryVariance = 1.0 / 1536.0;

struct Reference {
    std::string scene;
    std::string picture;
    double variance;
    glm::ivec2 dark_low{0};  // pixels where the reference is too dark
    glm::ivec2 dark_high{0};
};
// In the corner behind the mirror ball the reference has a quarter less light than our tracer, which agrees
// there with itself when it samples no emitters (PathTruth.sampled_emitters_give_what_chance_gives).
const Reference kCornell{"cornell", "cornell_256.exr", kCornellVariance, {40, 168}, {64, 200}};
const Reference kSurgery{"surgery", "surgery_512x384.exr", kSurgeryVariance};

// What is compared: a box of a picture whose pixels are `block` times as wide and high.
struct Part {
    int block = 8;
    glm::ivec2 low{0};
    glm::ivec2 high{1 << 20};  // beyond the picture: all of it
    TruthRequest request;
};

bool is_sound(const Reference& reference, int block, glm::ivec2 at) {
    const glm::ivec2 pixel = at * block;
    return pixel.x < reference.dark_low.x || pixel.y < reference.dark_low.y ||
           pixel.x >= reference.dark_high.x || pixel.y >= reference.dark_high.y;
}

// Mean and variance over the pixels of a block.
TruthPixel block_of(const Image& image, int block, glm::ivec2 at) {
    const auto planes = colour_planes(image).value();
    const double count = block * block;
    TruthPixel result{glm::dvec3(0.0), glm::dvec3(0.0)};
    for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0.0, squares = 0.0;
        for (int i = 0; i < block * block; ++i) {
            const int pixel = (at.y * block + i / block) * image.width + at.x * block + i % block;
            const auto value = static_cast<double>(planes[c][static_cast<std::size_t>(pixel)]);
            sum += value;
            squares += value * value;
        }
        const auto k = static_cast<int>(c);
        result.mean[k] = sum / count;
        result.variance_of_mean[k] = std::max(0.0, squares / count - result.mean[k] * result.mean[k]);
    }
    return result;
}

// Two samples of a block may be equal and the next one differ: at the rim of an emitter, or where a bright
// path is rare. A variance that has not seen it is too small. So each variance is the mean over a block and
// its neighbours, and at least that between the reference's pixels inside the block (law of total variance).
void smooth_variances(Part part, std::vector<TruthPixel>& traced, const std::vector<TruthPixel>& theirs) {
    const std::vector<TruthPixel> before = traced;
    const glm::ivec2 size = part.high - part.low;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            glm::dvec3 sum(0.0);
            double count = 0.0;
            for (int j = std::max(0, y - 1); j <= std::min(size.y - 1, y + 1); ++j) {
                for (int i = std::max(0, x - 1); i <= std::min(size.x - 1, x + 1); ++i) {
                    sum += before[static_cast<std::size_t>(j * size.x + i)].variance_of_mean;
                    count += 1.0;
                }
            }
            const auto at = static_cast<std::size_t>(y * size.x + x);
            const glm::dvec3 within = theirs[at].variance_of_mean / static_cast<double>(part.request.spp);
            traced[at].variance_of_mean = glm::max(sum / count, within);
        }
    }
}

PictureZ z_against(const Reference& reference, const Scene& scene, Part part) {
    const Image image = read_exr(shared_data() / "data" / "reference" / reference.picture);
    const test::TruthWorld world = test::truth_world(scene);
    part.request.size = {image.width / part.block, image.height / part.block};
    part.high = glm::min(part.high, part.request.size);
    std::vector<TruthPixel> traced, expected;
    for (int y = part.low.y; y < part.high.y; ++y) {
        for (int x = part.low.x; x < part.high.x; ++x) {
            traced.push_back(test::trace_truth_pixel(world, part.request, {x, y}));
            expected.push_back(block_of(image, part.block, {x, y}));
            if (!is_sound(reference, part.block, {x, y})) expected.back() = traced.back();
        }
    }
    smooth_variances(part, traced, expected);
    const double share = reference.variance * part.request.spp / (part.block * part.block);
    for (std::size_t i = 0; i < traced.size(); ++i)
        expected[i].variance_of_mean = traced[i].variance_of_mean * share;
    return test::picture_z(traced, expected);
}

Scene scene_of(const Reference& reference) {
    return load_scene(std::filesystem::path(VX_SOURCE_DIR) / "scenes" / (reference.scene + ".toml"));
}

void record(const PictureZ& z) {
    testing::Test::RecordProperty("rms", std::to_string(z.rms));
    testing::Test::RecordProperty("beyond_4", std::to_string(z.beyond_4));
    for (int c = 0; c < 3; ++c)
        testing::Test::RecordProperty("mean_" + std::to_string(c), std::to_string(z.of_mean[c]));
}

// Of pictures that agree. Smoothed variances make the root of the mean square somewhat smaller than 1.
constexpr double kMaxRms = 1.06;
constexpr double kMinRms = 0.85;
constexpr double kMaxBeyond4 = 0.0015;  // two other programs that agree had 0.0012
constexpr double kMaxOfMean = 3.0;
// Where most of the light has gone through glass, bright paths are so rare that tails stay heavy.
constexpr double kMaxRmsOfGlass = 1.2;
// Of pictures that differ.
constexpr double kClearRms = 1.4;
constexpr double kClearBeyond4 = 0.01;

bool agrees(const PictureZ& z) {
    const double worst = std::max({std::abs(z.of_mean.x), std::abs(z.of_mean.y), std::abs(z.of_mean.z)});
    return z.rms > kMinRms && z.rms < kMaxRms && z.beyond_4 < kMaxBeyond4 && worst < kMaxOfMean;
}

// The glass ball and its caustic.
const Part kGlass{.low = {17, 18}, .high = {29, 30}, .request = {.spp = 3072}};

TEST(PathTruthExternal, cornell_box_agrees_with_the_reference) {
    SKIP_WITHOUT_SHARED_DATA();
    const PictureZ z = z_against(kCornell, scene_of(kCornell), {.request = {.spp = 512}});
    record(z);
    EXPECT_TRUE(agrees(z)) << z.rms << ' ' << z.beyond_4 << ' ' << z.of_mean.x;
}

TEST(PathTruthExternal, glass_ball_and_caustic_agree_with_the_reference) {
    SKIP_WITHOUT_SHARED_DATA();
    const PictureZ z = z_against(kCornell, scene_of(kCornell), kGlass);
    record(z);
    EXPECT_LT(z.rms, kMaxRmsOfGlass);
    EXPECT_LT(z.beyond_4, kClearBeyond4);
}

TEST(PathTruthExternal, wrong_law_of_refraction_is_caught) {
    SKIP_WITHOUT_SHARED_DATA();
    Part part = kGlass;
    part.request.squares_the_sine = true;
    const PictureZ z = z_against(kCornell, scene_of(kCornell), part);
    record(z);
    EXPECT_GT(z.rms, kClearRms);
    EXPECT_GT(z.beyond_4, kClearBeyond4);
}

TEST(PathTruthExternal, emitter_moved_by_one_unit_is_caught) {
    SKIP_WITHOUT_SHARED_DATA();
    Scene scene = scene_of(kCornell);
    scene.spheres.at(7).centre.x += 1.0;
    const PictureZ z = z_against(kCornell, scene, {.request = {.spp = 512}});
    record(z);
    EXPECT_GT(z.rms, kClearRms);
    EXPECT_GT(z.beyond_4, kClearBeyond4);
}

TEST(PathTruthExternal, surgery_room_agrees_with_the_reference) {
    SKIP_WITHOUT_SHARED_DATA();
    const PictureZ z = z_against(kSurgery, scene_of(kSurgery), {.block = 16, .request = {.spp = 256}});
    record(z);
    EXPECT_TRUE(agrees(z)) << z.rms << ' ' << z.beyond_4 << ' ' << z.of_mean.x;
}

TEST(PathTruthExternalNightly, cornell_box_agrees_with_the_reference_in_finer_pixels) {
    SKIP_WITHOUT_SHARED_DATA();
    const PictureZ z = z_against(kCornell, scene_of(kCornell), {.block = 4, .request = {.spp = 4096}});
    record(z);
    EXPECT_TRUE(agrees(z)) << z.rms << ' ' << z.beyond_4 << ' ' << z.of_mean.x;
}

}  // namespace
}  // namespace voxilux
