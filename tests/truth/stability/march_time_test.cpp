// Hard case 8: what bad directions cost.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <limits>

#include "support/traversal_name.h"
#include "truth/stability/march_checkers.h"

namespace voxilux {
namespace {

// Bad rays may take this many times as long as good ones, with the best of ten tries each (as Embree's test
// of NaN and infinity).
constexpr double kMaxTime = 2.5;
constexpr int kTries = 10;
constexpr int kRays = 20000;

// Least CPU seconds that all threads of the process spend on one call, driver and readback included. Tries
// end early once one took no longer than `enough`.
double cpu_seconds(const MarchWorld& march_world, const std::vector<gpu::Ray>& rays, double enough = 0.0) {
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kTries && best > enough; ++i) {
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

std::vector<gpu::Ray> with_length(std::vector<gpu::Ray> rays, float length) {
    for (gpu::Ray& ray : rays)
        ray.direction *= length;
    return rays;
}

struct BadRays {
    std::string what;
    std::vector<gpu::Ray> rays;
    bool misses;  // whether all bad rays must miss
};

std::vector<BadRays> bad_rays(const std::vector<gpu::Ray>& good) {
    const float inf = std::numeric_limits<float>::infinity();
    const float denormal = 64.0f * std::numeric_limits<float>::denorm_min();
    std::vector<BadRays> bad;
    for (const float value :
         {std::numeric_limits<float>::quiet_NaN(), inf, -inf, 0.0f, denormal, 1e-30f, 1e-15f, 1e30f}) {
        for (const int every : {1, 8})
            bad.push_back({fmt::format("{} in one of {}", value, every), with_components(good, value, every),
                           !(std::abs(value) < inf)});
    }
    for (const float length : {0.0f, denormal, 1e-30f, 1e-15f, 1e30f})
        bad.push_back({fmt::format("length {}", length), with_length(good, length), length < 1e-20f});
    return bad;
}

class BadDirections : public ::testing::TestWithParam<Traversal> {};

TEST_P(BadDirections, row08_take_at_most_two_and_a_half_times_the_time_of_good_ones) {
    const VoxelWorld& world = test::world_named("random_0.001");
    const MarchWorld march_world = build_march_world(world, GetParam());
    const std::vector<gpu::Ray> good = test::family_named("random", world.size(), kRays);
    const double allowed = kMaxTime * cpu_seconds(march_world, good);
    for (const BadRays& bad : bad_rays(good))
        EXPECT_LE(cpu_seconds(march_world, bad.rays, allowed), allowed) << bad.what;
}

// Each bad ray is a miss that says why, and no good ray beside it changes.
TEST_P(BadDirections, row08_are_counted_misses_and_leave_the_rays_beside_them_alone) {
    const VoxelWorld& world = test::world_named("random_0.02");
    const MarchWorld march_world = build_march_world(world, GetParam());
    const std::vector<gpu::Ray> good = test::family_named("random", world.size(), 800);
    const auto want = test::march_on_device(march_world, good);
    for (const BadRays& bad : bad_rays(good)) {
        const auto got = test::march_on_device(march_world, bad.rays);
        for (std::size_t i = 0; i < good.size(); ++i) {
            const bool is_good = gpu::is_sound(bad.rays[i]);
            ASSERT_EQ(got[i].hit.fault, is_good ? gpu::kMarchFine : gpu::kMarchUnsound) << bad.what;
            ASSERT_TRUE(is_good || got[i].hit.face == gpu::kFaceMiss) << bad.what;
            ASSERT_TRUE(is_good || bad.misses) << bad.what;
            if (bad.rays[i].direction != good[i].direction) continue;
            ASSERT_EQ(test::difference(got[i].hit, want[i].hit), "") << bad.what;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(HardCase, BadDirections, ::testing::ValuesIn(all_traversals()),
                         test::traversal_name);

// Negative control: rays that go ten times as far through a world without boxes exceed the allowed time.
TEST(BadDirectionsChecker, sees_rays_that_take_longer_than_is_allowed) {
    const VoxelWorld world(glm::ivec3(0), glm::ivec3(64, 1, 1));
    MarchWorld march_world = build_unexpanded_world(world, all_traversals().back());
    gpu::Ray ray{{1000, 8, 8}, glm::vec3(0.5f), {-1, 0, 0}, gpu::kUnbounded};
    const std::vector<gpu::Ray> slow(kRays, ray);
    ray.direction.x = 1.0f;
    const std::vector<gpu::Ray> fast(kRays, ray);
    const double allowed = kMaxTime * cpu_seconds(march_world, fast);
    EXPECT_GT(cpu_seconds(march_world, slow, allowed), allowed);
}

}  // namespace
}  // namespace voxilux
