// Texels of an image of the sky and directions in them.

#include "shared/sky_image.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/statistics.h"

namespace voxilux {
namespace {

using glm::vec2;
using glm::vec3;

constexpr gpu::SkyGrid kSkyGrids[] = {{1, 1, 0.0f},       {2, 1, 0.25f},       {1, 3, -0.5f},
                                      {16, 8, 0.0f},      {37, 19, 0.314159f}, {512, 256, 0.4999f},
                                      {4096, 2048, 0.1f}, {1, 8388608, 0.0f},  {8388608, 1, 0.0f}};

TEST(SkyImageGrid, directions_in_a_texel_look_it_up_again) {
    test::TestRandom random(3);
    for (const gpu::SkyGrid grid : kSkyGrids) {
        const gpu::uint texels = grid.columns * grid.rows;
        // Half a texel from its border, up to the rounding of azimuths (2^-22 of a turn) and of polar angles.
        const double wide = std::min(0.49, 1e-6 * std::max(grid.columns, grid.rows));
        const bool is_fine = std::max(grid.columns, grid.rows) > 100000;
        for (int i = 0; i < 2000 && !is_fine; ++i) {
            const gpu::uint texel = i < 8 ? (i % 2 == 0 ? 0 : texels - 1) : random.bits32() % texels;
            const vec2 place(random.uniform(wide, 1.0 - wide), random.uniform(wide, 1.0 - wide));
            const vec3 direction = gpu::sky_direction(grid, texel, place);
            ASSERT_NEAR(glm::length(direction), 1.0f, 1e-6f);
            ASSERT_EQ(gpu::sky_texel(grid, direction), texel)
                << grid.columns << 'x' << grid.rows << ' ' << place.x << ' ' << place.y;
        }
    }
}

TEST(SkyImageGrid, hard_directions_have_a_texel) {
    for (const gpu::SkyGrid grid : kSkyGrids) {
        for (const float x : {-1.0f, -0.0f, 0.0f, 1e-30f, 1.0f})
            for (const float y : {-1.0f, -0.0f, 0.0f, 1e-30f, 1.0f})
                for (const float z : {-1.0f, -0.0f, 0.0f, 1.0f})
                    EXPECT_LT(gpu::sky_texel(grid, {x, y, z}), grid.columns * grid.rows);
    }
}

TEST(SkyImageGrid, middle_looks_along_x_and_left_of_it_is_y) {
    const gpu::SkyGrid grid{8, 4, 0.0f};
    const auto column_of = [&](float x, float y) { return gpu::sky_texel(grid, {x, y, 0.01f}) % 8u; };
    EXPECT_EQ(column_of(1.0f, 0.1f), 3u);   // just left of the middle
    EXPECT_EQ(column_of(1.0f, -0.1f), 4u);  // just right of it
    EXPECT_EQ(column_of(0.1f, 1.0f), 2u);
    EXPECT_EQ(gpu::sky_texel(grid, {0.1f, 0.1f, 0.98f}) / 8u, 0u) << "the zenith is on top";
    const gpu::SkyGrid turned{8, 4, 0.25f};  // the middle is in the direction +y
    EXPECT_EQ(gpu::sky_texel(turned, {-0.1f, 1.0f, 0.01f}) % 8u, 3u);
    EXPECT_EQ(gpu::sky_texel(turned, {0.1f, 1.0f, 0.01f}) % 8u, 4u);
}

// Uniform over the solid angle: heights within a row are uniform, by Archimedes' theorem.
double deviation_of_heights(const gpu::SkyGrid& grid, gpu::uint row, double stretch) {
    constexpr int kDraws = 20000, kSkyBins = 20;
    test::TestRandom random(5);
    const double top = std::cos(std::numbers::pi * row / grid.rows);
    const double bottom = std::cos(std::numbers::pi * (row + 1) / grid.rows);
    std::vector<std::uint64_t> seen(kSkyBins, 0);
    for (int i = 0; i < kDraws; ++i) {
        const vec2 place(random.uniform(0.0, 1.0), std::pow(random.uniform(0.0, 1.0), stretch));
        const vec3 direction = gpu::sky_direction(grid, row * grid.columns, place);
        const double part = (top - double{direction.z}) / (top - bottom);
        ++seen[static_cast<std::size_t>(std::clamp(part * kSkyBins, 0.0, kSkyBins - 1.0))];
    }
    const std::vector<double> expected(kSkyBins, double{kDraws} / kSkyBins);
    return test::chi_square(seen, expected);
}

TEST(SkyImageGrid, directions_in_a_texel_are_uniform_over_its_solid_angle) {
    for (const gpu::uint row : {0u, 1u, 3u, 4u, 6u})
        EXPECT_LT(deviation_of_heights({16, 7, 0.0f}, row, 1.0), test::chi_square_critical_99(19)) << row;
    EXPECT_GT(deviation_of_heights({16, 7, 0.0f}, 3, 1.05), test::chi_square_critical_99(19));
}

// The smallest texels, at a pole: 1 - z is known to a float's precision, z itself is not.
TEST(SkyImageGrid, texels_at_a_pole_keep_their_shape) {
    const gpu::SkyGrid grid{4096, 2048, 0.0f};
    test::TestRandom random(7);
    double sum = 0.0;
    constexpr int kDraws = 10000;
    const double edge = std::numbers::pi / 2048.0;
    for (int i = 0; i < kDraws; ++i) {
        const vec3 direction = gpu::sky_direction(grid, 5, {0.5f, random.uniform(0.0, 1.0)});
        const double radius = std::hypot(double{direction.x}, double{direction.y});
        ASSERT_LE(radius, edge * 1.00001);
        sum += radius * radius / (edge * edge);  // uniform
    }
    EXPECT_NEAR(sum / kDraws, 0.5, 4.0 * std::sqrt(1.0 / 12.0 / kDraws));
}

}  // namespace
}  // namespace voxilux
