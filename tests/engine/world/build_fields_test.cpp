// Structures with boxes that several threads have made, against their rules word by word.

#include "world/build_fields.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "support/traversal_name.h"
#include "world/leaf_block.h"
#include "world/world_view.h"

namespace voxilux {
namespace {

// Walls and dust in more chunks than a thread takes at once; some chunks are solid or empty, bricks repeat.
VoxelWorld dusty_world() {
    std::mt19937 dice(20261);
    VoxelWorld world(glm::ivec3(0), glm::ivec3(9, 8, 10));
    const glm::ivec3 size = world.size();
    world.fill({{3, 5, 40}, {size.x - 3, size.y - 2, 43}}, 1);
    world.fill({{30, 9, 50}, {33, size.y - 9, 130}}, 2);
    world.fill({{64, 64, 96}, {96, 96, 128}}, 3);
    for (int i = 0; i < 20000; ++i) {
        const auto below = [&](int n) { return static_cast<int>(dice() % static_cast<unsigned>(n)); };
        world.put({below(size.x), below(size.y), below(80)},
                  static_cast<std::uint16_t>(i % 4 == 0 ? 0 : 0x8000 | i % 3));
    }
    return world;
}

// visit(brick cell, its cell in the structure): chunk by chunk in the order of the grid.
template <class Visit>
void for_each_brick(const MarchWorld& built, const Visit& visit) {
    for (std::uint32_t chunk = 0; chunk < gpu::grid_index(built.chunks_size - 1, built.chunks_size) + 1;
         ++chunk) {
        const glm::ivec3 home = gpu::grid_cell(chunk, built.chunks_size);
        for (std::uint32_t slot = 0; slot < 64; ++slot) {
            if (!gpu::has_brick_nodes(static_cast<gpu::uint>(built.traversal)))
                visit(gpu::child_cell(home, slot), built.roots[64 * chunk + slot]);
            else if (gpu::cell_state(built.roots[chunk]) == gpu::kCellMixed)
                visit(gpu::child_cell(home, slot),
                      built.nodes[64 * gpu::cell_payload(built.roots[chunk]) + slot]);
        }
    }
}

LeafBlock block_at(const MarchWorld& built, std::uint32_t number) {
    LeafBlock block;
    std::copy_n(&built.leaves.at(block.size() * number), block.size(), block.begin());
    return block;
}

class BuildFields : public ::testing::TestWithParam<Traversal> {};

TEST_P(BuildFields, blocks_are_distinct_and_numbered_as_they_first_come) {
    const MarchWorld built = build_unexpanded_world(dusty_world(), GetParam());
    std::set<LeafBlock> blocks;
    std::uint32_t next = 0;
    for_each_brick(built, [&](glm::ivec3, std::uint32_t cell) {
        if (gpu::cell_state(cell) != gpu::kCellMixed) return;
        ASSERT_LE(gpu::cell_payload(cell), next);
        if (gpu::cell_payload(cell) == next) blocks.insert(block_at(built, next++));
    });
    EXPECT_GT(next, 1000u);
    EXPECT_EQ(blocks.size(), next);
    EXPECT_EQ(built.leaves.size(), std::size_t{next} * 32);
}

TEST_P(BuildFields, mixed_bricks_have_the_block_that_their_surroundings_call_for) {
    if (!has_free_boxes(GetParam())) GTEST_SKIP() << "boxes stay inside their brick: march_world_test";
    const VoxelWorld world = dusty_world();
    const MarchWorld built = build_unexpanded_world(world, GetParam());
    std::size_t mixed = 0;
    for_each_brick(built, [&](glm::ivec3 brick, std::uint32_t cell) {
        if (gpu::cell_state(cell) != gpu::kCellMixed) return;
        ++mixed;
        ASSERT_EQ(
            block_at(built, gpu::cell_payload(cell)),
            leaf_block(world.brick(world.brick_number(brick)), near_boxes(surroundings_of(world, brick))));
    });
    EXPECT_GT(mixed, 5000u);
}

// The steps of the shader, cell by cell.
void grow_plainly(MarchWorld& built, int log2) {
    const std::vector<glm::ivec3> homes = level_homes(built, log2);
    for (gpu::uint number = 0; number < gpu::kGrowthSteps; ++number) {
        std::vector<std::uint32_t> grown = level_words(built, log2);
        for (std::uint32_t i = 0; i < grown.size(); ++i) {
            const glm::ivec3 cell = log2 == gpu::kChunkLog2 ? gpu::grid_cell(i, built.chunks_size)
                                                            : gpu::child_cell(homes[i / 64], i % 64);
            grown[i] =
                gpu::grown_word(built, grown[i], cell, log2, built.chunks_size, gpu::growth_step(number));
        }
        level_words(built, log2) = grown;
    }
}

TEST_P(BuildFields, boxes_grow_as_in_the_shader) {
    MarchWorld plain = build_unexpanded_world(dusty_world(), GetParam());
    MarchWorld built = plain;
    for (const int log2 : growing_levels(GetParam()))
        grow_plainly(plain, log2);
    grow_boxes(built);
    EXPECT_TRUE(built.roots == plain.roots);
    EXPECT_TRUE(built.nodes == plain.nodes);
    // Negative control: before they grew.
    EXPECT_FALSE(build_unexpanded_world(dusty_world(), GetParam()).roots == built.roots);
}

INSTANTIATE_TEST_SUITE_P(structures, BuildFields,
                         ::testing::Values(Traversal::naadf, Traversal::deep, Traversal::wide),
                         test::traversal_name);

}  // namespace
}  // namespace voxilux
