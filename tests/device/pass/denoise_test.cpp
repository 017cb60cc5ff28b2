// The denoiser on the device against its oracle in double precision, and its hard cases.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "denoise_oracle.h"
#include "film/film.h"
#include "jobs/denoise_film.h"
#include "support/device_fixture.h"
#include "support/statistics.h"

namespace voxilux::test {
namespace {

// Floats against doubles: sums of 25 taps, and an inverse of a 4x4 matrix whose condition is below 500. The
// largest difference seen is 8e-6.
constexpr double kFloatError = 5e-5;

struct PlanesOfLight {
    glm::ivec2 size;
    std::array<DenoiseHalf, 2> halves;
};

// A floor and a wall whose edge lies inside pixels, a black strip, and noise.
PlanesOfLight noisy_planes(glm::ivec2 size, std::uint64_t seed) {
    TestRandom random(seed);
    PlanesOfLight all{.size = size};
    for (DenoiseHalf& half : all.halves) {
        for (int i = 0; i < size.x * size.y; ++i) {
            const int x = i % size.x, y = i / size.x;
            const auto wall = static_cast<float>(std::clamp(0.5 + 0.4 * (x - 0.45 * size.x), 0.0, 1.0));
            const bool is_black = y % 23 == 11;
            const auto noise = static_cast<float>(random.uniform(0.0, 1.0) + random.uniform(0.0, 1.0));
            const glm::vec3 albedo =
                is_black ? glm::vec3(0.0f) : glm::mix(glm::vec3(0.8f, 0.5f, 0.2f), glm::vec3(0.3f), wall);
            const glm::vec3 light = noise * glm::vec3(0.2f + 0.01f * static_cast<float>(x), 1.0f, 0.5f);
            half.albedo.emplace_back(albedo, 0.0f);
            half.reflected.emplace_back(albedo * light, 0.0f);
            half.sharp.emplace_back(glm::vec3(y > size.y / 2 ? 0.3f : 0.0f), 0.0f);
            half.normal.emplace_back(wall, 0.0f, 1.0f - wall, 3.0f * wall - 5.0f * (1.0f - wall));
        }
    }
    return all;
}

struct DeviceTexels {
    std::vector<glm::vec4> picture, errors;
};

DeviceTexels denoised_on(Executor& executor, const PlanesOfLight& planes, float share = 0.5f) {
    Recording recording;
    const DenoisedBuffers buffers =
        record_denoise(planes.size, planes.size.y, share, planes.halves, recording);
    const RunResult run = executor.run(recording);
    return {values_of<glm::vec4>(run, buffers.picture), values_of<glm::vec4>(run, buffers.errors)};
}

// The largest difference, in units of what is compared plus a tenth.
double difference_of(const DeviceTexels& device, const OracleDenoised& oracle) {
    double worst = 0.0;
    const auto compare = [&](double a, double b) {
        worst = std::max(worst, std::abs(a - b) / (std::abs(b) + 0.1));
        if (std::isnan(a)) worst = INFINITY;
    };
    for (std::size_t i = 0; i < device.picture.size(); ++i) {
        for (glm::length_t c = 0; c < 3; ++c)
            compare(static_cast<double>(device.picture[i][c]), oracle.picture[i][c]);
        compare(static_cast<double>(device.picture[i].w), oracle.relmse[i]);
        compare(static_cast<double>(device.errors[i].x), oracle.variance[i]);
        compare(static_cast<double>(device.errors[i].y), oracle.plain[i]);
        compare(static_cast<double>(device.errors[i].z), oracle.luminance[i]);
    }
    return worst;
}

TEST(Denoise, agrees_with_double_precision) {
    for (const auto& [size, share] :
         {std::pair{glm::ivec2(45, 38), 0.5}, {{64, 16}, 0.6}, {{3, 50}, 0.5}, {{1, 1}, 0.5}}) {
        const PlanesOfLight planes = noisy_planes(size, 7);
        const DeviceTexels device = denoised_on(test_executor(), planes, static_cast<float>(share));
        EXPECT_LT(difference_of(device, oracle_denoised(size, share, planes.halves)), kFloatError) << size.x;
    }
}

TEST(Denoise, differs_from_oracles_that_are_wrong) {
    const PlanesOfLight planes = noisy_planes({45, 38}, 7);
    const DeviceTexels device = denoised_on(test_executor(), planes);
    for (const OracleFault fault :
         {OracleFault::keeps_own_terms, OracleFault::ignores_planes, OracleFault::claims_without_variance})
        EXPECT_GT(difference_of(device, oracle_denoised(planes.size, 0.5, planes.halves, fault)),
                  4.0 * kFloatError)
            << static_cast<int>(fault);
}

bool same_texels(const DeviceTexels& a, const DeviceTexels& b) {
    return a.picture == b.picture && a.errors == b.errors;
}

TEST(Denoise, gives_the_same_bytes_for_any_workgroup) {
    const PlanesOfLight planes = noisy_planes({61, 47}, 3);
    const DeviceTexels expected = denoised_on(test_executor(), planes);
    for (const auto& group : {std::array{16u, 4u}, {5u, 3u}, {1u, 64u}}) {
        Executor executor(test_device(), pass_shaders(), {.group_size = group});
        EXPECT_TRUE(same_texels(denoised_on(executor, planes), expected)) << group[0];
    }
    EXPECT_FALSE(same_texels(denoised_on(test_executor(), noisy_planes({61, 47}, 4)), expected));
}

std::int64_t fixed(double value, std::uint32_t samples) {
    return std::llround(std::ldexp(value, kFilmFractionBits)) * static_cast<std::int64_t>(samples);
}

// A film whose pixels are all the same: a white plane of radiance 0.5.
FilmSums even_film(glm::ivec2 size, std::uint32_t even, std::uint32_t odd) {
    FilmSums film{.width = size.x, .height = size.y};
    film.even.assign(static_cast<std::size_t>(size.y), even);
    film.odd.assign(static_cast<std::size_t>(size.y), odd);
    const std::size_t pixels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
    for (const auto& [half, samples] : {std::pair{"_a", even}, {"_b", odd}}) {
        film.sums[std::string("beauty") + half].assign(3 * pixels, fixed(0.5, samples));
        film.sums[std::string("guide_sharp") + half].assign(3 * pixels, 0);
        film.sums[std::string("guide_albedo") + half].assign(3 * pixels, fixed(1.0, samples));
        film.sums[std::string("guide_normal") + half].assign(3 * pixels, 0);
        for (std::size_t i = 0; i < pixels; ++i)
            film.sums[std::string("guide_normal") + half][3 * i + 2] = fixed(1.0, samples);
        film.sums[std::string("guide_offset") + half].assign(pixels, fixed(-2.0, samples));
    }
    return film;
}

bool is_finite_picture(const Denoised& denoised) {
    for (const std::vector<float>& values : denoised.rgb)
        if (!std::ranges::all_of(values, [](float v) { return std::isfinite(v) && v >= 0.0f; })) return false;
    return std::ranges::all_of(denoised.error, [](float v) { return std::isfinite(v) && v >= 0.0f; }) &&
           std::isfinite(denoised.claim.estimate);
}

TEST(Denoise, keeps_the_plain_picture_of_a_single_sample) {
    const Denoised denoised = denoise_film(even_film({20, 20}, 1, 0), test_executor());
    EXPECT_FALSE(denoised.is_filtered());
    EXPECT_NE(denoised.reason.find("even"), std::string::npos) << denoised.reason;
    EXPECT_TRUE(denoised.rgb[0].empty());
    EXPECT_TRUE(denoise_film(even_film({20, 20}, 1, 1), test_executor()).is_filtered());
}

TEST(Denoise, leaves_a_constant_picture_as_it_is) {
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {1, 40}, {33, 18}}) {
        const Denoised denoised = denoise_film(even_film(size, 3, 2), test_executor());
        ASSERT_TRUE(denoised.is_filtered() && is_finite_picture(denoised));
        for (const float value : denoised.rgb[1])
            ASSERT_NEAR(value, 0.5f, 1e-6f);  // rounding of 25 weights
        EXPECT_NEAR(denoised.claim.estimate, 0.0, 1e-5);
    }
}

TEST(Denoise, takes_black_pictures_and_surfaces) {
    FilmSums film = even_film({33, 18}, 2, 2);
    for (const char* plane : {"guide_albedo_a", "guide_albedo_b", "guide_normal_a", "guide_normal_b"})
        std::ranges::fill(film.sums.at(plane), 0);  // misses: features have no variance at all
    Denoised denoised = denoise_film(film, test_executor());
    ASSERT_TRUE(denoised.is_filtered() && is_finite_picture(denoised));
    EXPECT_EQ(denoised.rgb[0], std::vector<float>(33 * 18, 0.5f)) << "nothing reflects: as it is";
    for (const char* plane : {"beauty_a", "beauty_b"})
        std::ranges::fill(film.sums.at(plane), 0);
    denoised = denoise_film(film, test_executor());
    ASSERT_TRUE(is_finite_picture(denoised));
    EXPECT_EQ(denoised.rgb[0], std::vector<float>(33 * 18, 0.0f));
}

TEST(Denoise, survives_a_firefly) {
    FilmSums film = even_film({48, 48}, 8, 8);
    film.sums.at("beauty_a")[3 * (48 * 20 + 20)] = fixed(1e6, 8);
    const Denoised denoised = denoise_film(film, test_executor());
    ASSERT_TRUE(is_finite_picture(denoised) || !denoised.is_filtered());
    // The plain picture is off by 1e6 in a pixel: whatever is written, its estimated error must not be small.
    EXPECT_TRUE(!denoised.is_filtered() || denoised.claim.high > 100.0) << denoised.claim.high;
}

TEST(Denoise, cuts_into_strips_that_fit_without_a_trace) {
    FilmSums film = even_film({24, 300}, 4, 4);
    TestRandom random(11);
    for (const char* plane : {"beauty_a", "beauty_b"})
        for (std::int64_t& sum : film.sums.at(plane))
            sum = fixed(random.uniform(0.0, 1.0), 4);
    for (std::size_t i = 0; i < 24 * 300; ++i)
        if (i % 24 > 11)
            film.sums.at("guide_offset_a")[i] = film.sums.at("guide_offset_b")[i] = fixed(9.0, 4);
    const Denoised whole = denoise_film(film, test_executor());
    ASSERT_TRUE(whole.is_filtered());
    for (const std::size_t rows : {1u, 120u, 200u}) {
        const Denoised cut = denoise_film(film, test_executor(), 24 * rows);
        EXPECT_EQ(cut.rgb, whole.rgb) << rows;
        EXPECT_EQ(cut.error, whole.error) << rows;
        EXPECT_GT(cut.passes.front().count, whole.passes.front().count);
    }
}

}  // namespace
}  // namespace voxilux::test
