// The boxes of a brick's cells against the same growth done cell by cell.

#include "world/near_boxes.h"

#include <gtest/gtest.h>

#include <random>

#include <glm/glm.hpp>

#include "shared/world_cell.h"

namespace voxilux {
namespace {

constexpr std::uint32_t kNearSeed = 20266;

// `cell` from -4 to 7, counted from the middle brick.
bool is_filled(const BrickSurroundings& filled, glm::ivec3 cell) {
    const glm::ivec3 brick = (cell + 4) / 4;
    const glm::ivec3 local = (cell + 4) % 4;
    const std::uint64_t mask = filled[static_cast<std::size_t>(brick.x + 3 * brick.y + 9 * brick.z)];
    return ((mask >> (local.x + 4 * local.y + 16 * local.z)) & 1u) != 0;
}

bool is_free(const BrickSurroundings& filled, glm::ivec3 low, glm::ivec3 high) {
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x)
                if (is_filled(filled, {x, y, z})) return false;
    return true;
}

std::uint32_t plain_box(const BrickSurroundings& filled, glm::ivec3 cell) {
    if (is_filled(filled, cell)) return 0;
    glm::ivec3 low = cell;
    glm::ivec3 high = cell;
    std::array<int, 6> distance{};
    for (int round = 1; round <= 3; ++round) {
        for (int direction = 0; direction < 6; ++direction) {
            if (distance[static_cast<std::size_t>(direction)] != round - 1) continue;
            const int axis = direction / 2;
            glm::ivec3& end = direction % 2 == 0 ? low : high;
            glm::ivec3 slab_low = low;
            glm::ivec3 slab_high = high;
            slab_low[axis] = slab_high[axis] = cell[axis] + (direction % 2 == 0 ? -round : round);
            if (!is_free(filled, slab_low, slab_high)) continue;
            end[axis] = slab_low[axis];
            distance[static_cast<std::size_t>(direction)] = round;
        }
    }
    std::uint32_t packed = 0;
    for (std::uint32_t direction = 0; direction < 6; ++direction)
        packed |= static_cast<std::uint32_t>(distance[direction]) << (direction * gpu::kNearBits);
    return packed;
}

// Each cell filled with a chance of one in `one_in`.
BrickSurroundings random_surroundings(unsigned one_in, std::mt19937& dice) {
    BrickSurroundings filled{};
    for (std::uint64_t& mask : filled)
        for (int i = 0; i < 64; ++i)
            mask |= static_cast<std::uint64_t>(dice() % one_in == 0) << i;
    return filled;
}

int count_differences(const BrickSurroundings& seen, const BrickSurroundings& truth) {
    const std::array<std::uint16_t, 64> boxes = near_boxes(seen);
    int differences = 0;
    for (std::uint32_t i = 0; i < 64; ++i)
        differences += boxes[i] != plain_box(truth, gpu::slot_cell(i)) ? 1 : 0;
    return differences;
}

TEST(NearBoxes, equal_growth_cell_by_cell_at_every_density) {
    std::mt19937 dice(kNearSeed);
    for (unsigned one_in = 1; one_in <= 400; ++one_in) {
        const BrickSurroundings filled = random_surroundings(one_in, dice);
        ASSERT_EQ(count_differences(filled, filled), 0) << "one cell in " << one_in;
    }
}

TEST(NearBoxes, reach_three_cells_everywhere_in_an_empty_world) {
    for (const std::uint16_t box : near_boxes({}))
        EXPECT_EQ(box, 0xFFF);
}

TEST(NearBoxes, judge_sees_a_voxel_moved_in_the_brick_beside) {
    BrickSurroundings filled{};
    filled[14] = 1;
    BrickSurroundings other = filled;
    other[14] = 2;
    EXPECT_GT(count_differences(filled, other), 0);
}

}  // namespace
}  // namespace voxilux
