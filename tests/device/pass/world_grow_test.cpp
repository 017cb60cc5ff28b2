// The boxes grown on the device against those grown on the CPU.

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "passes/world.h"
#include "shared/hash.h"
#include "shared/world_cell.h"
#include "support/device_fixture.h"
#include "support/ray_families.h"
#include "support/traversal_name.h"
#include "world/build_fields.h"

namespace voxilux {
namespace {

constexpr std::uint32_t kSeed = 20264;

std::string declare(Recording& recording, const std::string& name, std::uint64_t words) {
    recording.declare({.name = name, .size_bytes = std::max<std::uint64_t>(words, 1) * 4});
    return name;
}

std::vector<std::uint32_t> words_of(const RunResult& result, const std::string& name, std::size_t count) {
    std::vector<std::uint32_t> words(count);
    std::memcpy(words.data(), result.readbacks.at(name).data(), count * 4);
    return words;
}

MarchWorld grown_on_device(MarchWorld unexpanded) {
    const GrowthNeeds needs = growth_needs(unexpanded);
    Recording recording;
    const WorldBuffers buffers{.roots = declare(recording, "test.roots", unexpanded.roots.size()),
                               .nodes = declare(recording, "test.nodes", unexpanded.nodes.size()),
                               .leaves = declare(recording, "test.leaves", unexpanded.leaves.size()),
                               .homes = declare(recording, "test.homes", needs.home_bytes / 4),
                               .grown = declare(recording, "test.grown", needs.grown_bytes / 4),
                               .unused = declare(recording, "test.unused", 1)};
    record_world_build(unexpanded, needs, buffers, recording);
    for (const std::string& name : {buffers.roots, buffers.nodes, buffers.leaves})
        recording.readback(name);
    const RunResult result = test_executor().run(recording);
    unexpanded.roots = words_of(result, buffers.roots, unexpanded.roots.size());
    unexpanded.nodes = words_of(result, buffers.nodes, unexpanded.nodes.size());
    unexpanded.leaves = words_of(result, buffers.leaves, unexpanded.leaves.size());
    return unexpanded;
}

class WorldGrow : public ::testing::TestWithParam<Traversal> {};

TEST_P(WorldGrow, device_gives_the_bits_of_the_cpu_for_every_small_world) {
    for (const test::NamedWorld& named : test::small_worlds(kSeed)) {
        const MarchWorld want = build_march_world(named.world, GetParam());
        const MarchWorld got = grown_on_device(build_unexpanded_world(named.world, GetParam()));
        EXPECT_EQ(got.roots, want.roots) << named.name;
        EXPECT_EQ(got.nodes, want.nodes) << named.name;
        EXPECT_EQ(got.leaves, want.leaves) << named.name;
    }
}

INSTANTIATE_TEST_SUITE_P(Pass, WorldGrow, ::testing::ValuesIn(all_traversals()), test::traversal_name);

// More cells than a dispatch of 65,535 groups in a row takes (hole 11 of the list of hard cases), of chunks
// or of bricks.
class WorldGrowNightly : public ::testing::TestWithParam<Traversal> {};

std::vector<Traversal> structures_with_boxes() {
    std::vector<Traversal> found;
    std::ranges::copy_if(all_traversals(), std::back_inserter(found),
                         [](Traversal traversal) { return !growing_levels(traversal).empty(); });
    return found;
}

TEST_P(WorldGrowNightly, b11_roots_of_more_than_65535_groups_get_the_bits_of_the_cpu) {
    const int log2 = gpu::root_log2(static_cast<gpu::uint>(GetParam()));
    VoxelWorld world(glm::ivec3(0), glm::ivec3(256, 128, 132) / (1 << (gpu::kChunkLog2 - log2)));
    for (std::uint32_t i = 0; i < 3000; ++i)
        world.set(glm::ivec3(gpu::pcg3d(glm::uvec3(i, kSeed, 1)) % glm::uvec3(world.size())), 1);
    const MarchWorld want = build_march_world(world, GetParam());
    ASSERT_GT(want.roots.size(), std::size_t{65535} * 64);
    const MarchWorld got = grown_on_device(build_unexpanded_world(world, GetParam()));
    EXPECT_TRUE(got.roots == want.roots && got.nodes == want.nodes && got.leaves == want.leaves);
}

INSTANTIATE_TEST_SUITE_P(Pass, WorldGrowNightly, ::testing::ValuesIn(structures_with_boxes()),
                         test::traversal_name);

// A voxel in each chunk: the nodes of one structure and the roots of the other pass the 128 MiB of a binding.
TEST(WorldGrowLargeNightly, levels_over_the_binding_limit_get_the_bits_of_the_cpu) {
    constexpr int chunks = 82;
    VoxelWorld world(glm::ivec3(0), glm::ivec3(chunks));
    for (int i = 0; i < chunks * chunks * chunks; ++i) {
        const glm::ivec3 chunk = gpu::grid_cell(static_cast<gpu::uint>(i), world.chunks());
        world.set(chunk * 16 + glm::ivec3(gpu::pcg3d(glm::uvec3(chunk)) & 15u), 1);
    }
    for (const Traversal traversal : {Traversal::deep, Traversal::wide}) {
        const MarchWorld want = build_march_world(world, traversal);
        ASSERT_GT(std::max(want.nodes.size(), want.roots.size()), std::size_t{128 << 20} / 4);
        const MarchWorld got = grown_on_device(build_unexpanded_world(world, traversal));
        EXPECT_TRUE(got.roots == want.roots && got.nodes == want.nodes && got.leaves == want.leaves)
            << name_of(traversal);
    }
}

TEST(WorldGrowChecker, sees_a_world_that_differs_by_one_voxel) {
    test::NamedWorld named = test::small_worlds(kSeed).back();
    const MarchWorld want = build_march_world(named.world, Traversal::wide);
    glm::ivec3 empty(1);
    while (named.world.get(empty) != VoxelWorld::kEmpty)
        ++empty.x;
    named.world.set(empty, 1);
    const MarchWorld got = grown_on_device(build_unexpanded_world(named.world, Traversal::wide));
    EXPECT_FALSE(got.leaves == want.leaves && got.roots == want.roots);
}

}  // namespace
}  // namespace voxilux
