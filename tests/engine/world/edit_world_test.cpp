// Edited structures against structures built anew from the edited voxels.

#include "world/edit_world.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "support/ray_families.h"
#include "support/traversal_name.h"
#include "world/world_view.h"

namespace voxilux {
namespace {

constexpr std::uint32_t kEditSeed = 20265;

// The first voxel whose cell, with its box, differs between two structures; empty when there is none. Blocks
// may have other numbers.
std::string first_difference(const MarchWorld& a, const MarchWorld& b) {
    const glm::ivec3 size = a.size();
    for (int z = 0; z < size.z; ++z) {
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const gpu::MarchCell in_a = gpu::find_cell(a, {x, y, z}, a.chunks_size);
                const gpu::MarchCell in_b = gpu::find_cell(b, {x, y, z}, b.chunks_size);
                if (in_a.cell != in_b.cell || in_a.log2 != in_b.log2 || in_a.bits != in_b.bits)
                    return fmt::format("({}, {}, {}): {:#x} at level {}, {:#x} at level {}", x, y, z,
                                       in_a.cell, in_a.log2, in_b.cell, in_b.log2);
            }
        }
    }
    return "";
}

void patch(const std::vector<std::uint32_t>& from, const std::vector<WordRange>& ranges,
           std::vector<std::uint32_t>& words) {
    words.resize(from.size());
    for (const WordRange& range : ranges)
        std::copy(from.begin() + static_cast<std::ptrdiff_t>(range.first),
                  from.begin() + static_cast<std::ptrdiff_t>(range.end),
                  words.begin() + static_cast<std::ptrdiff_t>(range.first));
}

// The arrays of `before`, patched with these words, must equal those of `after`.
void expect_changes_suffice(MarchWorld before, const WorldChanges& changes, const MarchWorld& after) {
    if (changes.is_rebuilt) return;
    patch(after.roots, changes.roots, before.roots);
    patch(after.nodes, changes.nodes, before.nodes);
    patch(after.leaves, changes.leaves, before.leaves);
    EXPECT_EQ(before.roots, after.roots);
    EXPECT_EQ(before.nodes, after.nodes);
    EXPECT_EQ(before.leaves, after.leaves);
}

// Edits a world and its structure, which must then equal one built anew as soon as its boxes have grown.
void expect_edit_equals_a_rebuild(VoxelWorld& world, MarchWorld& built, std::span<const VoxelEdit> edits) {
    const MarchWorld before = built;
    expect_changes_suffice(before, edit_world(world, built, edits), built);
    const MarchWorld edited = built;
    Regrowth regrowth(built);
    (void)regrowth.step();
    expect_changes_suffice(edited, regrowth.finish(built), built);
    ASSERT_EQ(first_difference(built, build_march_world(world, built.traversal)), "");
}

std::vector<VoxelEdit> random_edits(const VoxelWorld& world, int count, double clears, std::mt19937& dice) {
    std::vector<VoxelEdit> edits;
    for (int i = 0; i < count; ++i) {
        const glm::ivec3 at(glm::uvec3(dice(), dice(), dice()) % glm::uvec3(world.size()));
        const bool clear = static_cast<double>(dice() % 1000) < 1000.0 * clears;
        edits.push_back(
            {at, clear ? VoxelWorld::kEmpty : static_cast<std::uint16_t>(0x8000u | (dice() % 3))});
    }
    return edits;
}

class EditWorld : public ::testing::TestWithParam<Traversal> {};

TEST_P(EditWorld, random_edits_of_every_small_world_equal_a_rebuild) {
    std::mt19937 dice(kEditSeed);
    for (test::NamedWorld& named : test::small_worlds(kEditSeed)) {
        MarchWorld built = build_march_world(named.world, GetParam());
        for (const int count : {1, 1, 7}) {
            SCOPED_TRACE(named.name);
            expect_edit_equals_a_rebuild(named.world, built, random_edits(named.world, count, 0.4, dice));
        }
    }
}

TEST_P(EditWorld, chunks_that_fill_empty_and_split_equal_a_rebuild) {
    VoxelWorld world(glm::ivec3(0), glm::ivec3(9, 2, 2));
    MarchWorld built = build_march_world(world, GetParam());
    const auto fill = [&](std::uint16_t voxel) {
        std::vector<VoxelEdit> edits;
        for (int i = 0; i < 4096; ++i)
            edits.push_back({glm::ivec3(64 + i % 16, i / 16 % 16, i / 256), voxel});
        expect_edit_equals_a_rebuild(world, built, edits);
    };
    fill(0x8001);
    const VoxelEdit hole{{70, 5, 5}, VoxelWorld::kEmpty};
    expect_edit_equals_a_rebuild(world, built, std::span(&hole, 1));
    fill(0x8002);
    fill(VoxelWorld::kEmpty);
    EXPECT_EQ(world.voxel_count(), 0u);
}

TEST_P(EditWorld, voxels_far_away_and_far_apart_equal_a_rebuild) {
    VoxelWorld world(glm::ivec3(0), glm::ivec3(40, 1, 1));
    world.set({8, 8, 8}, 1);
    MarchWorld built = build_march_world(world, GetParam());
    const VoxelEdit far{{630, 3, 3}, 0x8001};
    expect_edit_equals_a_rebuild(world, built, std::span(&far, 1));
    const VoxelEdit both_ends[] = {{{3, 3, 3}, 0x8001}, {{600, 9, 9}, 0x8002}};
    expect_edit_equals_a_rebuild(world, built, both_ends);
}

// An edit alone leaves boxes that are too small, and says so.
TEST(EditWorldBoxes, edit_that_clears_a_brick_has_stale_boxes_until_they_grow) {
    VoxelWorld world(glm::ivec3(0), glm::ivec3(5));
    for (int i = 0; i < 64; ++i)
        world.set(glm::ivec3(40) + gpu::slot_cell(static_cast<gpu::uint>(i)), 1);
    MarchWorld built = build_march_world(world, Traversal::wide);
    const VoxelEdit one{{40, 40, 40}, VoxelWorld::kEmpty};
    EXPECT_FALSE(edit_world(world, built, std::span(&one, 1)).has_stale_boxes) << "the brick is still mixed";
    EXPECT_EQ(first_difference(built, build_march_world(world, Traversal::wide)), "");
    std::vector<VoxelEdit> all;
    for (int i = 0; i < 64; ++i)
        all.push_back({glm::ivec3(40) + gpu::slot_cell(static_cast<gpu::uint>(i)), VoxelWorld::kEmpty});
    EXPECT_TRUE(edit_world(world, built, all).has_stale_boxes);
    EXPECT_NE(first_difference(built, build_march_world(world, Traversal::wide)), "");
}

TEST_P(EditWorld, judge_sees_a_voxel_that_was_set_behind_the_structure) {
    VoxelWorld world(glm::ivec3(0), glm::ivec3(3));
    world.set({20, 20, 20}, 1);
    const MarchWorld built = build_march_world(world, GetParam());
    world.put({40, 20, 20}, 0x8001);
    EXPECT_NE(first_difference(built, build_march_world(world, GetParam())), "");
}

INSTANTIATE_TEST_SUITE_P(Structure, EditWorld, ::testing::ValuesIn(all_traversals()), test::traversal_name);

TEST(EditWorldBlocks, an_edit_inside_a_mixed_brick_adds_few_blocks) {
    std::mt19937 dice(kEditSeed);
    VoxelWorld world(glm::ivec3(0), glm::ivec3(4));
    for (int i = 0; i < 20000; ++i)
        world.set(glm::ivec3(glm::uvec3(dice(), dice(), dice()) % glm::uvec3(world.size())), 1);
    MarchWorld built = build_march_world(world, Traversal::wide);
    const std::size_t before = built.leaves.size() / 32;
    const VoxelEdit edit{{30, 30, 30}, 0x8002};
    edit_world(world, built, std::span(&edit, 1));
    EXPECT_LE(built.leaves.size() / 32, before + 28)
        << "the brick, its copy with boxes, and its 26 neighbours";
}

}  // namespace
}  // namespace voxilux
