// The march on the device: the same bits as in C++, and the cells of the double-precision oracle.

#include <gtest/gtest.h>

#include "support/march_oracle.h"
#include "support/march_probe.h"
#include "support/ray_families.h"
#include "support/same_bits.h"
#include "support/traversal_name.h"

namespace voxilux {
namespace {

constexpr std::uint32_t kSeed = 20262;
// Voxels. Rounding moves a crossing by at most 2^-23 of the path, 60 voxels here; the margin is far above it.
constexpr double kMargin = 1e-3;

std::vector<gpu::Ray> all_rays(glm::ivec3 size, int count) {
    std::vector<gpu::Ray> rays;
    for (const test::RayFamily& family : test::ray_families(size, count, kSeed))
        rays.insert(rays.end(), family.rays.begin(), family.rays.end());
    return rays;
}

// Rays from outside: each start cell is moved far back along its ray.
std::vector<gpu::Ray> moved_back(std::vector<gpu::Ray> rays, float distance) {
    for (gpu::Ray& ray : rays)
        ray.cell -= glm::ivec3(glm::floor(ray.direction * distance));
    return rays;
}

class MarchOnDevice : public ::testing::TestWithParam<Traversal> {};

TEST_P(MarchOnDevice, every_family_in_every_world_gives_the_bits_of_cpp) {
    for (const test::NamedWorld& named : test::small_worlds(kSeed)) {
        const MarchWorld march_world = build_march_world(named.world, GetParam());
        std::vector<gpu::Ray> rays = all_rays(march_world.size(), 1500);
        for (const float distance : {40.0f, 3000.0f, 1e6f}) {
            const std::vector<gpu::Ray> far = moved_back(all_rays(march_world.size(), 300), distance);
            rays.insert(rays.end(), far.begin(), far.end());
        }
        const auto want = test::march_in_cpp(march_world, rays);
        for (const auto access : {test::WorldAccess::texels, test::WorldAccess::pointers}) {
            const auto got = test::march_on_device(march_world, rays, access);
            const auto difference = test::differing_bits<gpu::MarchProbe>(got, want);
            EXPECT_EQ(difference.count, 0u)
                << named.name << " ray " << test::print(rays[difference.first]) << ", " << difference.detail;
        }
    }
}

TEST_P(MarchOnDevice, every_family_agrees_with_boxes_in_double_precision) {
    for (const test::NamedWorld& named : test::small_worlds(kSeed + 1)) {
        const MarchWorld march_world = build_march_world(named.world, GetParam());
        const std::vector<glm::ivec3> solids = test::solid_cells(named.world);
        const std::vector<gpu::Ray> rays = all_rays(march_world.size(), solids.size() > 2000 ? 15 : 60);
        const auto got = test::march_on_device(march_world, rays);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const test::OracleBounds bounds = test::oracle_bounds(solids, rays[i], kMargin);
            ASSERT_EQ(test::disagreement(bounds, rays[i], got[i].hit, kMargin), "")
                << named.name << " " << test::print(rays[i]);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Probe, MarchOnDevice, ::testing::ValuesIn(all_traversals()), test::traversal_name);

TEST(MarchOnDeviceChecker, a_ray_changed_in_its_last_bit_is_caught_by_the_comparison) {
    const MarchWorld march_world = build_march_world(test::small_worlds(kSeed)[9].world);
    std::vector<gpu::Ray> rays = all_rays(march_world.size(), 100);
    const auto got = test::march_on_device(march_world, rays);
    for (gpu::Ray& ray : rays)
        ray.direction.x = std::nextafter(ray.direction.x, 2.0f);
    EXPECT_GT(test::differing_bits<gpu::MarchProbe>(got, test::march_in_cpp(march_world, rays)).count,
              rays.size() / 4);
}

}  // namespace
}  // namespace voxilux
