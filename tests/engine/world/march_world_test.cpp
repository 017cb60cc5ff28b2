#include "world/march_world.h"

#include <gtest/gtest.h>

#include <random>

#include "shared/world_cell.h"
#include "support/grow_aadf.h"
#include "support/ray_families.h"

namespace voxilux {
namespace {

std::vector<std::uint8_t> cells_of(std::uint64_t mask) {
    std::vector<std::uint8_t> filled(64);
    for (std::size_t i = 0; i < 64; ++i)
        filled[i] = static_cast<std::uint8_t>((mask >> i) & 1u);
    return filled;
}

std::vector<std::uint64_t> masks() {
    std::mt19937_64 dice(11);
    std::vector<std::uint64_t> all = {0, ~std::uint64_t{0}, 1, std::uint64_t{1} << 63, 0x000000000000FFFFull};
    for (int i = 0; i < 300; ++i) {
        all.push_back(dice() & dice() & dice() & dice());
        all.push_back(dice() & dice());
    }
    return all;
}

// Whether the box of `extents` around `cell` is free of filled cells; beyond the grid all is `beyond_filled`.
bool box_is_empty(glm::ivec3 size, const std::vector<std::uint8_t>& filled, glm::ivec3 cell,
                  const Extents& extents, bool beyond_filled) {
    for (int z = cell.z - extents[4]; z <= cell.z + extents[5]; ++z) {
        for (int y = cell.y - extents[2]; y <= cell.y + extents[3]; ++y) {
            for (int x = cell.x - extents[0]; x <= cell.x + extents[1]; ++x) {
                const bool inside = x >= 0 && y >= 0 && z >= 0 && x < size.x && y < size.y && z < size.z;
                if (!inside && beyond_filled) return false;
                if (inside && filled[static_cast<std::size_t>(x + size.x * (y + size.y * z))] != 0)
                    return false;
            }
        }
    }
    return true;
}

TEST(Aadf, boxes_of_every_cell_are_empty_and_stay_inside) {
    for (const std::uint64_t mask : masks()) {
        const std::array<Extents, 64> extents = grow_aadf_4(mask);
        const std::vector<std::uint8_t> filled = cells_of(mask);
        for (int i = 0; i < 64; ++i) {
            const auto at = static_cast<std::size_t>(i);
            if (filled[at] != 0) {
                ASSERT_EQ(extents[at], Extents{});
                continue;
            }
            ASSERT_TRUE(box_is_empty(glm::ivec3(4), filled, {i % 4, i / 4 % 4, i / 16}, extents[at], true))
                << mask;
        }
    }
}

TEST(Aadf, parallel_form_equals_the_plain_one) {
    for (const std::uint64_t mask : masks()) {
        const std::vector<Extents> plain = grow_aadf(glm::ivec3(4), cells_of(mask), 3, Beyond::solid);
        const std::array<Extents, 64> parallel = grow_aadf_4(mask);
        ASSERT_TRUE(std::equal(plain.begin(), plain.end(), parallel.begin())) << mask;
    }
}

TEST(Aadf, box_check_rejects_an_extent_grown_by_one) {
    const std::uint64_t mask = std::uint64_t{1} << 21;  // one voxel at (1,1,1)
    const std::vector<std::uint8_t> filled = cells_of(mask);
    Extents extents = grow_aadf_4(mask)[0];
    ASSERT_TRUE(box_is_empty(glm::ivec3(4), filled, {0, 0, 0}, extents, true));
    extents = {0, 1, 0, 1, 0, 1};
    EXPECT_FALSE(box_is_empty(glm::ivec3(4), filled, {0, 0, 0}, extents, true));
}

TEST(Aadf, chunk_grid_boxes_are_empty_and_long) {
    const glm::ivec3 size(9, 7, 40);
    std::mt19937 dice(5);
    std::vector<std::uint8_t> filled(static_cast<std::size_t>(size.x * size.y * size.z));
    for (std::uint8_t& cell : filled)
        cell = dice() % 50 == 0 ? 1 : 0;
    const std::vector<Extents> extents = grow_aadf(size, filled, 31, Beyond::empty);
    std::uint64_t reach = 0;
    for (int i = 0; i < static_cast<int>(filled.size()); ++i) {
        const auto at = static_cast<std::size_t>(i);
        if (filled[at] != 0) continue;
        const glm::ivec3 cell(i % size.x, i / size.x % size.y, i / (size.x * size.y));
        ASSERT_TRUE(box_is_empty(size, filled, cell, extents[at], false));
        for (const std::uint8_t extent : extents[at])
            reach += extent;
    }
    EXPECT_GT(reach / filled.size(),
              6u);  // more than one chunk per direction on average: the boxes are of use
}

TEST(Aadf, empty_grid_reaches_the_maximum) {
    const std::vector<std::uint8_t> filled(27, 0);
    for (const Extents& extents : grow_aadf(glm::ivec3(3), filled, 31, Beyond::empty))
        EXPECT_EQ(extents, (Extents{31, 31, 31, 31, 31, 31}));
}

std::uint32_t lookup(const MarchWorld& march_world, glm::ivec3 local) {
    const glm::ivec3 c = local >> 4;
    const std::uint32_t chunk = march_world.roots[static_cast<std::size_t>(
        c.x + march_world.chunks_size.x * (c.y + march_world.chunks_size.y * c.z))];
    if (gpu::cell_state(chunk) != gpu::kCellMixed) return chunk;
    const std::uint32_t brick =
        march_world.nodes[gpu::cell_payload(chunk) * 64 + gpu::child_slot((local >> 2) & 3)];
    if (gpu::cell_state(brick) != gpu::kCellMixed) return brick;
    const std::uint32_t slot = gpu::child_slot(local & 3);
    const std::uint32_t word = march_world.leaves[gpu::cell_payload(brick) * 32 + slot / 2];
    return gpu::cell_of_voxel((word >> (16 * (slot % 2))) & 0xFFFFu);
}

TEST(MarchWorld, every_voxel_reads_back_with_its_material) {
    for (const test::NamedWorld& named : test::small_worlds(3)) {
        const MarchWorld march_world = build_march_world(named.world);
        const glm::ivec3 size = march_world.size();
        for (int z = 0; z < size.z; ++z) {
            for (int y = 0; y < size.y; ++y) {
                for (int x = 0; x < size.x; ++x) {
                    const std::uint16_t voxel = named.world.get({x, y, z});
                    const std::uint32_t cell = lookup(march_world, {x, y, z});
                    ASSERT_EQ(gpu::cell_state(cell) == gpu::kCellSolid, voxel != VoxelWorld::kEmpty)
                        << named.name;
                    if (voxel == VoxelWorld::kEmpty) continue;
                    ASSERT_EQ(gpu::cell_payload(cell), voxel & 0x7FFFu);
                }
            }
        }
    }
}

TEST(MarchWorld, equal_bricks_are_stored_once_and_uniform_chunks_not_at_all) {
    VoxelWorld world(glm::ivec3(0), glm::ivec3(3, 1, 1));
    for (int x = 0; x < 32; x += 4)
        world.set({x, 0, 0}, 9);
    for (int i = 0; i < 16 * 16 * 16; ++i)
        world.set({32 + i % 16, i / 16 % 16, i / 256}, 4);
    const MarchWorld march_world = build_march_world(world);
    EXPECT_EQ(march_world.leaves.size(), 32u);
    EXPECT_EQ(march_world.nodes.size(), 128u);
    EXPECT_EQ(march_world.roots[2], gpu::make_cell(gpu::kCellSolid, 4));
}

TEST(VoxelWorld, last_write_wins_and_outside_is_empty) {
    VoxelWorld world(glm::ivec3(-5, 0, 0), glm::ivec3(1));
    world.set({1, 2, 3}, 4);
    world.set({1, 2, 3}, 5);
    EXPECT_EQ(world.get({1, 2, 3}), 0x8005);
    EXPECT_EQ(world.voxel_count(), 1u);
    EXPECT_EQ(world.get({-1, 0, 0}), VoxelWorld::kEmpty);
    EXPECT_EQ(world.get({16, 0, 0}), VoxelWorld::kEmpty);
}

}  // namespace
}  // namespace voxilux
