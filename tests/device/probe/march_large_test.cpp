// Worlds with an array that is larger than a binding may be: the march reads both of its ends, on the device
// as in C++.

#include <gtest/gtest.h>

#include <algorithm>

#include "shared/hash.h"
#include "support/march_probe.h"
#include "support/ray_families.h"
#include "support/same_bits.h"

namespace voxilux {
namespace {

constexpr std::uint32_t kLargeSeed = 20265;
constexpr std::size_t kBindingWords = (std::size_t{128} << 20) / 4;

// A voxel in each brick of a cube of chunks, no two bricks alike: none can be stored once for both.
VoxelWorld world_of_different_bricks(int chunks) {
    VoxelWorld world(glm::ivec3(0), glm::ivec3(chunks));
    const glm::ivec3 bricks(4 * chunks);
    std::uint32_t number = 0;
    for (int z = 0; z < bricks.z; ++z)
        for (int y = 0; y < bricks.y; ++y)
            for (int x = 0; x < bricks.x; ++x, ++number)
                world.set(glm::ivec3(x, y, z) * 4 + gpu::slot_cell((number >> 15u) & 63u),
                          static_cast<std::uint16_t>(number & gpu::kVoxelPayloadMask));
    return world;
}

// A voxel in each chunk, on a diagonal of each row of them.
VoxelWorld world_of_different_chunks(int chunks) {
    VoxelWorld world(glm::ivec3(0), glm::ivec3(chunks));
    for (int z = 0; z < chunks; ++z)
        for (int y = 0; y < chunks; ++y)
            for (int x = 0; x < chunks; ++x)
                world.set(glm::ivec3(x, y, z) * 16 + (glm::ivec3(x, x + y, y + z) & 15), 1);
    return world;
}

// Rays that start in the cells next to the first and to the last voxels and look at them, and others that
// start anywhere.
std::vector<gpu::Ray> rays_at_both_ends(const VoxelWorld& world) {
    std::vector<glm::ivec3> solids;
    world.for_each_voxel([&](glm::ivec3 cell, std::uint16_t) { solids.push_back(cell); });
    constexpr std::size_t ends = 500;
    solids.erase(solids.begin() + ends, solids.end() - ends);
    std::vector<gpu::Ray> rays;
    for (const glm::ivec3 cell : solids)
        for (const int side : {-1, 1})
            rays.push_back({cell - glm::ivec3(side, 0, 0), glm::vec3(0.5f),
                            glm::vec3(static_cast<float>(side), 0.25f, -0.125f), 1e6f});
    for (const test::RayFamily& family : test::ray_families(world.size(), 100, kLargeSeed))
        rays.insert(rays.end(), family.rays.begin(), family.rays.end());
    return rays;
}

// The array that grows past a binding.
using Words = std::vector<std::uint32_t> MarchWorld::*;

// The device's rays against those of C++, and against those of a world whose last or first words are other.
void expect_march_reads_both_ends(const VoxelWorld& world, Traversal traversal, Words words) {
    MarchWorld unexpanded = build_unexpanded_world(world, traversal);
    ASSERT_GT((unexpanded.*words).size(), kBindingWords);
    const std::vector<gpu::Ray> rays = rays_at_both_ends(world);
    const auto got = test::march_on_device(unexpanded, rays);
    const auto difference = test::differing_bits<gpu::MarchProbe>(got, test::march_in_cpp(unexpanded, rays));
    EXPECT_EQ(difference.count, 0u) << test::print(rays[difference.first]) << ", " << difference.detail;
    constexpr std::ptrdiff_t block = 64;
    const auto first = (unexpanded.*words).begin();
    const auto last = (unexpanded.*words).end() - block;
    for (const auto& place : {first, last}) {
        const std::vector<std::uint32_t> kept(place, place + block);
        std::fill(place, place + block, 0u);
        const auto changed = test::march_in_cpp(unexpanded, rays);
        EXPECT_GT(test::differing_bits<gpu::MarchProbe>(got, changed).count, 0u);
        std::ranges::copy(kept, place);
    }
}

TEST(MarchLargeNightly, leaves_over_the_binding_limit_are_read_at_both_ends) {
    expect_march_reads_both_ends(world_of_different_bricks(26), Traversal::deep, &MarchWorld::leaves);
}

TEST(MarchLargeNightly, nodes_over_the_binding_limit_are_read_at_both_ends) {
    expect_march_reads_both_ends(world_of_different_chunks(82), Traversal::naadf, &MarchWorld::nodes);
}

TEST(MarchLargeNightly, roots_over_the_binding_limit_are_read_at_both_ends) {
    expect_march_reads_both_ends(world_of_different_chunks(82), Traversal::wide, &MarchWorld::roots);
}

}  // namespace
}  // namespace voxilux
