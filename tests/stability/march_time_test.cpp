// Hard case 8: what bad directions cost.

#include <gtest/gtest.h>

#include <ctime>
#include <limits>

#include "stability/march_judges.h"

namespace voxilux {
namespace {

// Bad rays may take this much longer than good ones, the best of ten tries each (as Embree's test of NaN and
// infinity).
constexpr double kMostTime = 2.5;
constexpr int kTries = 10;
constexpr int kRays = 20000;

// Seconds of CPU that all threads of the process spend on one call, driver and readback included.
double cpu_seconds(const MarchWorld& march_world, const std::vector<gpu::Ray>& rays) {
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kTries; ++i) {
        const std::clock_t start = std::clock();
        (void)test::march_on_device(march_world, rays);
        best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return best;
}

std::vector<gpu::Ray> with_components(std::vector<gpu::Ray> rays, float bad, int every) {
    for (std::size_t i = 0; i < rays.size(); i += static_cast<std::size_t>(every))
        rays[i].direction[static_cast<int>(i % 3)] = bad;
    return rays;
}

TEST(HardCase, row08_bad_directions_take_at_most_two_and_a_half_times_the_time_of_good_ones) {
    const VoxelWorld& world = test::world_named("random_0.001");
    const MarchWorld march_world = build_march_world(world);
    const std::vector<gpu::Ray> good = test::family_named("random", world.size(), kRays);
    const double allowed = kMostTime * cpu_seconds(march_world, good);
    const float inf = std::numeric_limits<float>::infinity();
    const float denormal = 64.0f * std::numeric_limits<float>::denorm_min();
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), inf, -inf, 0.0f, denormal, 1e-30f, 1e-15f, 1e30f}) {
        for (const int every : {1, 8})
            EXPECT_LT(cpu_seconds(march_world, with_components(good, bad, every)), allowed)
                << bad << " in one of " << every;
    }
    for (const float length : {denormal, 1e-15f, 1e30f}) {
        std::vector<gpu::Ray> scaled = good;
        for (gpu::Ray& ray : scaled)
            ray.direction *= length;
        EXPECT_LT(cpu_seconds(march_world, scaled), allowed) << "length " << length;
    }
}

}  // namespace
}  // namespace voxilux
