#include "support/light_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "support/frame_fixture.h"

namespace voxilux::test {
namespace {

// The mean of a block of a sample's colours.
glm::dvec3 block_mean(const std::vector<glm::vec3>& colour, int width, int block, glm::ivec2 at) {
    glm::dvec3 sum(0.0);
    for (int y = at.y * block; y < (at.y + 1) * block; ++y)
        for (int x = at.x * block; x < (at.x + 1) * block; ++x)
            sum += glm::dvec3(colour[static_cast<std::size_t>(y * width + x)]);
    return sum / static_cast<double>(block * block);
}

// Adds sample `number`, from 1, of a mean whose squared differences are kept in place of the variance.
// Source: Welford 1962.
void add_sample(TruthPixel& pixel, const glm::dvec3& value, double number) {
    const glm::dvec3 difference = value - pixel.mean;
    pixel.mean += difference / number;
    pixel.variance_of_mean += difference * (value - pixel.mean);
}

LightPicture smoothed(const LightPicture& picture) {
    LightPicture result = picture;
    for (int y = 0; y < picture.size.y; ++y) {
        for (int x = 0; x < picture.size.x; ++x) {
            glm::dvec3 sum(0.0);
            double count = 0.0;
            for (int j = std::max(0, y - 1); j <= std::min(picture.size.y - 1, y + 1); ++j) {
                for (int i = std::max(0, x - 1); i <= std::min(picture.size.x - 1, x + 1); ++i) {
                    sum += picture.at({i, j}).variance_of_mean;
                    count += 1.0;
                }
            }
            result.pixels[static_cast<std::size_t>(y * picture.size.x + x)].variance_of_mean = sum / count;
        }
    }
    return result;
}

}  // namespace

std::vector<LightPicture> render_light(Scene scene, const LightRequest& request) {
    scene.settings.sequence = Sequence::white;
    scene.settings.spp = request.iterations;
    const glm::ivec2 size = scene.settings.size;
    std::vector<LightPicture> pictures;
    for (const int block : request.blocks) {
        EXPECT_EQ(size % block, glm::ivec2(0));
        const glm::ivec2 blocks = size / block;
        pictures.push_back({blocks, std::vector<TruthPixel>(static_cast<std::size_t>(blocks.x * blocks.y),
                                                            {glm::dvec3(0.0), glm::dvec3(0.0)})});
    }
    FrameFixture fixture(scene, {.effects = request.effects});
    for (std::uint32_t i = 0; i < request.iterations; ++i) {
        const FramePlanes planes = fixture.render(i);
        for (std::size_t f = 0; f < gpu::kFaultCount; ++f)
            EXPECT_EQ(planes.counters[f], 0u) << "fault " << gpu::kCounterNames[f];
        for (std::size_t p = 0; p < pictures.size(); ++p) {
            for (int y = 0; y < pictures[p].size.y; ++y) {
                for (int x = 0; x < pictures[p].size.x; ++x)
                    add_sample(pictures[p].pixels[static_cast<std::size_t>(y * pictures[p].size.x + x)],
                               block_mean(planes.color, size.x, request.blocks[p], {x, y}), i + 1.0);
            }
        }
    }
    const double n = request.iterations;
    for (LightPicture& picture : pictures)
        for (TruthPixel& pixel : picture.pixels)
            pixel.variance_of_mean /= n * (n - 1.0);
    return pictures;
}

LightPicture coarser(const LightPicture& fine, int factor) {
    LightPicture result{fine.size / factor, {}};
    const double count = factor * factor;
    for (int y = 0; y < result.size.y; ++y) {
        for (int x = 0; x < result.size.x; ++x) {
            TruthPixel sum{glm::dvec3(0.0), glm::dvec3(0.0)};
            for (int j = 0; j < factor; ++j) {
                for (int i = 0; i < factor; ++i) {
                    sum.mean += fine.at({x * factor + i, y * factor + j}).mean / count;
                    sum.variance_of_mean +=
                        fine.at({x * factor + i, y * factor + j}).variance_of_mean / (count * count);
                }
            }
            result.pixels.push_back(sum);
        }
    }
    return result;
}

LightPicture truth_picture(const TruthWorld& world, const TruthRequest& request) {
    return {request.size, trace_truth(world, request)};
}

PictureZ light_z(const LightPicture& traced, const LightPicture& expected) {
    return picture_z(smoothed(traced).pixels, smoothed(expected).pixels);
}

namespace {

constexpr double kFarOff = 4.0;  // standard deviations; normal noise passes them once in 16000 times
constexpr double kMaxBeyond4 = 0.02;

double farthest(const PictureZ& z) {
    return std::max({std::abs(z.of_mean.x), std::abs(z.of_mean.y), std::abs(z.of_mean.z)});
}

}  // namespace

bool is_equal_light(const LightPicture& a, const LightPicture& b) {
    const PictureZ z = light_z(a, b);
    return z.rms < kMaxRms && z.beyond_4 < kMaxBeyond4 && farthest(z) < kFarOff;
}

void expect_equal_light(const LightPicture& a, const LightPicture& b, const char* what) {
    const PictureZ z = light_z(a, b);
    testing::Test::RecordProperty(what, std::to_string(z.rms));
    EXPECT_LT(z.rms, kMaxRms) << what;
    EXPECT_LT(z.beyond_4, kMaxBeyond4) << what;
    EXPECT_LT(farthest(z), kFarOff) << what;
}

}  // namespace voxilux::test
