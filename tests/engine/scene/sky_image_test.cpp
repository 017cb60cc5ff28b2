// What is computed of an image of the sky before a render: densities, and the light of faces.

#include "scene/sky_image.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "shared/dimensions.h"
#include "shared/sampling.h"
#include "shared/sky_image.h"
#include "support/statistics.h"

namespace voxilux {
namespace {

constexpr double kPi = std::numbers::pi;

Sky image_sky(glm::ivec2 size, glm::vec3 radiance = glm::vec3(1.0f)) {
    Sky sky{.model = SkyModel::image};
    sky.image.size = size;
    sky.image.texels.assign(static_cast<std::size_t>(size.x * size.y), radiance);
    return sky;
}

Sky random_sky(glm::ivec2 size) {
    Sky sky = image_sky(size);
    test::TestRandom random(4);
    for (glm::vec3& texel : sky.image.texels)
        texel = glm::vec3(std::exp(random.uniform(-4.0, 4.0)), random.uniform(0.0, 1.0), 0.2f);
    sky.image.texels[3] = glm::vec3(0.0f);
    return sky;
}

TEST(SkyImage, solid_angles_fill_the_sphere) {
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {2, 1}, {3, 5}, {64, 33}}) {
        double sum = 0.0;
        for (int row = 0; row < size.y; ++row)
            sum += size.x * sky_texel_solid_angle(size, row);
        EXPECT_NEAR(sum, 4.0 * kPi, 1e-12);
    }
}

TEST(SkyImage, densities_add_up_to_one_and_follow_the_luminance) {
    const Sky sky = random_sky({64, 32});
    const SkySampler sampler = sky_sampler(sky);
    double sum = 0.0;
    for (std::size_t i = 0; i < sampler.texels.size(); ++i)
        sum += double{sampler.texels[i].w} * sky_texel_solid_angle({64, 32}, static_cast<int>(i / 64));
    EXPECT_NEAR(sum, 1.0, 1e-6);
    EXPECT_EQ(sampler.texels[3].w, 0.0f) << "nothing is drawn where it is black";
    const auto ratio = [&](std::size_t i) {
        const gpu::vec4 texel = sampler.texels[i];
        return double{texel.w} /
               (0.2126 * double{texel.x} + 0.7152 * double{texel.y} + 0.0722 * double{texel.z});
    };
    for (const std::size_t i : {64u, 500u, 2047u})
        EXPECT_NEAR(ratio(i) / ratio(0), 1.0, 1e-3);  // probabilities are multiples of 2^-24 / texels
}

struct SkyCounts {
    double chi_square = 0.0;
    std::size_t freedom = 0;
};

// Counts of directions that are drawn as the shader draws them, in texels that are looked up, against the
// densities. `lean` moves the densities of every other texel up or down.
SkyCounts count_texels(double lean) {
    const Sky sky = random_sky({16, 8});
    const SkySampler sampler = sky_sampler(sky);
    const gpu::SkyGrid grid{16, 8, 0.3f};
    constexpr gpu::uint kDraws = 1000000;
    std::vector<std::uint64_t> counts(sampler.texels.size(), 0), seen;
    for (gpu::uint i = 0; i < kDraws; ++i) {
        const gpu::SkyNumbers u = gpu::sky_numbers(gpu::sample_key(i, {0u, 0u}, 9u), i % 3);
        const gpu::uint bucket = gpu::alias_bucket(u.bits, 128);
        const gpu::uint texel = gpu::alias_choice(sampler.table[bucket], bucket, u.choice);
        ++counts[gpu::sky_texel(grid, gpu::sky_direction(grid, texel, u.place))];
    }
    std::vector<double> expected;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const double area = sky_texel_solid_angle({16, 8}, static_cast<int>(i / 16));
        const double wanted =
            kDraws * double{sampler.texels[i].w} * area * (1.0 + (i % 2 == 0 ? lean : -lean));
        if (wanted < 20.0) continue;
        expected.push_back(wanted);
        seen.push_back(counts[i]);
    }
    return {test::chi_square(seen, expected), expected.size() - 1};
}

TEST(SkyImage, texels_are_drawn_as_often_as_their_density_says) {
    const SkyCounts right = count_texels(0.0), off = count_texels(0.01);
    EXPECT_GT(right.freedom, 60u);
    EXPECT_LT(right.chi_square, test::chi_square_critical_99(right.freedom));
    EXPECT_GT(off.chi_square, test::chi_square_critical_99(off.freedom)) << "1 % off is caught";
}

TEST(SkyImage, faces_under_a_constant_image_have_its_radiance) {
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {3, 2}, {16, 7}}) {
        Sky sky = image_sky(size, {1.0f, 2.0f, 0.25f});
        sky.rotation_deg = 77.0f;
        for (const glm::vec3& light : sky_face_light(sky))
            EXPECT_LT(glm::length(light - glm::vec3(1.0f, 2.0f, 0.25f)), 1e-6f);
    }
}

// By many directions of each texel.
std::array<glm::dvec3, 6> face_light_by_sums(const Sky& sky) {
    const glm::ivec2 size = sky.image.size;
    const gpu::SkyGrid grid{static_cast<gpu::uint>(size.x), static_cast<gpu::uint>(size.y),
                            sky.rotation_deg / 360.0f};
    constexpr int kSide = 64;
    std::array<glm::dvec3, 6> light{};
    for (gpu::uint texel = 0; texel < sky.image.texels.size(); ++texel) {
        const double area =
            sky_texel_solid_angle(size, static_cast<int>(texel / grid.columns)) / (kSide * kSide);
        for (int k = 0; k < kSide * kSide; ++k) {
            const glm::vec2 place = (glm::vec2(k % kSide, k / kSide) + 0.5f) / float{kSide};
            const glm::dvec3 direction(gpu::sky_direction(grid, texel, place));
            for (gpu::uint face = 0; face < 6; ++face)
                light[face] += glm::dvec3(sky_texel_radiance(sky, texel)) * area / kPi *
                               std::max(glm::dot(direction, glm::dvec3(gpu::face_normal(face))), 0.0);
        }
    }
    return light;
}

TEST(SkyImage, faces_receive_the_integral_of_any_image) {
    for (const float rotation : {0.0f, 33.0f, -270.0f, 1234.5f}) {
        Sky sky = random_sky({12, 7});
        sky.strength = 0.5f;
        sky.rotation_deg = rotation;
        const std::array<glm::dvec3, 6> expected = face_light_by_sums(sky);
        const std::array<glm::vec3, 6> found = sky_face_light(sky);
        for (std::size_t face = 0; face < 6; ++face)
            for (int c = 0; c < 3; ++c)  // 1e-3: of sums over 64 x 64 directions, where a face cuts a texel
                EXPECT_NEAR(double{found[face][c]}, expected[face][c], 1e-3 * expected[face][c]);
        sky.rotation_deg += 10.0f;
        EXPECT_GT(glm::length(glm::dvec3(sky_face_light(sky)[1]) - expected[1]), 2e-3 * expected[1].x);
    }
}

TEST(SkyImage, hard_images) {
    EXPECT_FALSE(has_light(image_sky({4, 2}, glm::vec3(0.0f)).image));
    EXPECT_TRUE(sky_sampler(image_sky({4, 2}, glm::vec3(0.0f))).table.empty());
    const SkySampler one = sky_sampler(image_sky({1, 1}));
    EXPECT_NEAR(one.texels[0].w, 0.25 / kPi, 1e-8);
    Sky spot = image_sky({64, 32}, glm::vec3(0.0f));
    spot.image.texels[700] = glm::vec3(kMaxRadiance);
    spot.strength = 1e6f;
    const SkySampler sampler = sky_sampler(spot);
    EXPECT_EQ(sampler.texels[700].x, kMaxRadiance) << "no radiance leaves its range";
    EXPECT_NEAR(double{sampler.texels[700].w} * sky_texel_solid_angle({64, 32}, 700 / 64), 1.0, 1e-6);
}

}  // namespace
}  // namespace voxilux
