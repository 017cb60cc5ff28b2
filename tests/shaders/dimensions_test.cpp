// The numbers of paths, and which directions are in a cone.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "shared/dielectric.h"
#include "shared/dimensions.h"
#include "shared/sampling.h"

namespace voxilux {
namespace {

TEST(PathNumbers, uses_and_surfaces_share_none) {
    std::set<float> seen;
    for (gpu::uint surface = 0; surface < 100; ++surface)
        for (gpu::uint use = 0; use < gpu::kUsesOfSurface; ++use)
            seen.insert(gpu::path_numbers({3, 5, 7}, surface, use).x);
    EXPECT_GT(seen.size(), 695u) << "of 700; two of 2^24 values meet once in 70 times";
}

TEST(PathNumbers, are_uniform_and_uncorrelated_from_use_to_use) {
    constexpr int kCount = 65536;
    glm::dvec3 sum(0.0), squares(0.0), product(0.0);
    for (gpu::uint i = 0; i < kCount; ++i) {
        const glm::dvec3 a(gpu::path_numbers({i, 0, 1}, 2, gpu::kUseSun));
        const glm::dvec3 b(gpu::path_numbers({i, 0, 1}, 2, gpu::kUseImage));
        sum += a;
        squares += a * a;
        product += (a - 0.5) * (b - 0.5);
    }
    const double sigma = 1.0 / std::sqrt(double{kCount});
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(sum[c] / kCount, 0.5, 4.0 * sigma / std::sqrt(12.0));
        EXPECT_NEAR(squares[c] / kCount, 1.0 / 3.0, 4.0 * sigma * std::sqrt(4.0 / 45.0));
        EXPECT_NEAR(product[c] / kCount, 0.0, 4.0 * sigma / 12.0);
    }
}

// Directions drawn in a cone are in it but for a rounding at its rim, and those drawn in one twice as wide
// are in it in proportion to the solid angle.
TEST(IsInCone, agrees_with_directions_that_are_drawn_in_cones) {
    for (const float degrees : {0.05f, 0.53f, 20.0f}) {
        const float height = gpu::cone_height(degrees * 3.14159265f / 360.0f);
        const gpu::vec3 axis = gpu::trimmed(gpu::vec3(0.3f, -0.5f, 0.7f));
        int own = 0, wide = 0;
        constexpr int kCount = 20000;
        for (gpu::uint i = 0; i < kCount; ++i) {
            const gpu::vec2 u(gpu::rng_float(1, i, 0, 0), gpu::rng_float(1, i, 0, 1));
            own += gpu::is_in_cone(gpu::uniform_cone(axis, height, u), axis, height) ? 1 : 0;
            wide += gpu::is_in_cone(gpu::uniform_cone(axis, 4.0f * height, u), axis, height) ? 1 : 0;
        }
        EXPECT_GT(own, kCount - 20) << degrees;
        EXPECT_NEAR(wide, kCount / 4, 250) << degrees;
    }
}

}  // namespace
}  // namespace voxilux
