// Every box that a structure stores is free of voxels: brute force over all its cells.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "shared/aadf.h"
#include "support/box_check.h"
#include "support/grow_aadf.h"
#include "support/ray_families.h"
#include "support/traversal_name.h"
#include "world/build_fields.h"
#include "world/edit_world.h"
#include "world/world_view.h"

namespace voxilux {
namespace {

constexpr std::uint32_t kBoxesSeed = 20265;

class EmptyBoxes : public ::testing::TestWithParam<Traversal> {};

std::string lie_of(const VoxelWorld& world, Traversal traversal) {
    return test::first_lie(world, test::FilledCount(world), build_march_world(world, traversal));
}

// Where a block of 2^3 voxels lies: in a brick, across bricks, across chunks, in the corners of the world.
struct Place {
    glm::ivec3 chunks;
    glm::ivec3 corner;
};
constexpr std::array<Place, 5> kPlaces = {{{glm::ivec3(1), glm::ivec3(1)},
                                           {glm::ivec3(1), glm::ivec3(3)},
                                           {glm::ivec3(1), glm::ivec3(14)},
                                           {glm::ivec3(2), glm::ivec3(15)},
                                           {glm::ivec3(1, 2, 1), glm::ivec3(0, 15, 14)}}};

TEST_P(EmptyBoxes, are_empty_for_every_filling_of_eight_voxels_wherever_they_lie) {
    for (const Place& place : kPlaces) {
        for (int filling = 0; filling < 256; ++filling) {
            VoxelWorld world(glm::ivec3(0), place.chunks);
            for (int i = 0; i < 8; ++i) {
                if (((filling >> i) & 1) != 0)
                    world.set(place.corner + glm::ivec3(i & 1, (i >> 1) & 1, i >> 2),
                              static_cast<std::uint16_t>(i % 2));
            }
            ASSERT_EQ(lie_of(world, GetParam()), "") << "filling " << filling << " at " << place.corner.x;
        }
    }
}

constexpr std::array<glm::ivec3, 5> kLayouts = {glm::ivec3(2), glm::ivec3(2, 2, 3), glm::ivec3(3, 2, 2),
                                                glm::ivec3(2, 4, 2), glm::ivec3(5, 2, 2)};

// A block of 6^3 to 20^3 cells somewhere in a few chunks, from nearly empty to nearly full, of one to three
// materials.
VoxelWorld random_filling(std::mt19937& dice) {
    const auto below = [&](int n) { return static_cast<int>(dice() % static_cast<std::uint32_t>(n)); };
    const int edge = 6 + below(15);
    VoxelWorld world(glm::ivec3(0), kLayouts[dice() % kLayouts.size()]);
    const glm::ivec3 room = world.size() - edge;
    const glm::ivec3 corner(below(room.x + 1), below(room.y + 1), below(room.z + 1));
    constexpr std::array kPerThousand = {2, 10, 50, 200, 500, 900, 1000};
    const int density = kPerThousand[dice() % kPerThousand.size()];
    const int materials = 1 + below(3);
    for (int i = 0; i < edge * edge * edge; ++i) {
        if (below(1000) < density)
            world.set(corner + glm::ivec3(i % edge, i / edge % edge, i / edge / edge),
                      static_cast<std::uint16_t>(below(materials)));
    }
    return world;
}

void expect_truth(Traversal traversal, int fillings, std::uint32_t seed) {
    std::mt19937 dice(seed);
    for (int i = 0; i < fillings; ++i)
        ASSERT_EQ(lie_of(random_filling(dice), traversal), "") << "seed " << seed << ", filling " << i;
}

TEST_P(EmptyBoxes, are_empty_for_random_fillings) {
    expect_truth(GetParam(), 60, kBoxesSeed);
}

using EmptyBoxesNightly = EmptyBoxes;
TEST_P(EmptyBoxesNightly, are_empty_for_thousands_of_random_fillings) {
    expect_truth(GetParam(), 5000, kBoxesSeed + 1);
}

// A cube of 1, 4 or 16 cells set to one material or cleared: a voxel, about a brick, about a chunk.
std::vector<VoxelEdit> random_box_edits(glm::ivec3 size, std::mt19937& dice) {
    constexpr std::array kEdges = {1, 1, 4, 4, 16};
    const int edge = kEdges[dice() % kEdges.size()];
    const bool is_aligned = dice() % 2 == 0;
    glm::ivec3 corner(glm::uvec3(dice(), dice(), dice()) % glm::uvec3(size - edge + 1));
    if (is_aligned) corner = corner / edge * edge;
    const auto voxel = static_cast<std::uint16_t>(dice() % 2 == 0 ? 0u : gpu::kVoxelSolidBit | dice() % 3);
    std::vector<VoxelEdit> edits;
    for (int i = 0; i < edge * edge * edge; ++i)
        edits.push_back({corner + glm::ivec3(i % edge, i / edge % edge, i / edge / edge), voxel});
    return edits;
}

TEST_P(EmptyBoxes, are_empty_after_random_edits) {
    std::mt19937 dice(kBoxesSeed + 5);
    for (int filling = 0; filling < 8; ++filling) {
        VoxelWorld world = random_filling(dice);
        MarchWorld built = build_march_world(world, GetParam());
        for (int edit = 0; edit < 8; ++edit) {
            edit_world(world, built, random_box_edits(world.size(), dice));
            ASSERT_EQ(test::first_lie(world, test::FilledCount(world), built), "")
                << "filling " << filling << ", edit " << edit;
            if (edit == 4) (void)Regrowth(built).finish(built);
        }
    }
}

// Negative control: a distance that is raised by one and then reaches a voxel is noticed everywhere.
TEST_P(EmptyBoxes, one_distance_raised_by_one_into_a_voxel_is_caught) {
    std::mt19937 dice(kBoxesSeed + 2);
    int raised = 0;
    for (int filling = 0; filling < 12; ++filling) {
        const VoxelWorld world = random_filling(dice);
        const test::FilledCount filled(world);
        MarchWorld built = build_march_world(world, GetParam());
        const glm::ivec3 size = world.size();
        for (int tries = 0; tries < 200; ++tries) {
            const glm::ivec3 local(glm::uvec3(dice(), dice(), dice()) % glm::uvec3(size));
            const test::StoredDistances stored = test::stored_distances(built, local);
            const auto direction = static_cast<std::uint32_t>(dice() % 6);
            if (stored.word == nullptr || world.get(local) != VoxelWorld::kEmpty) continue;
            const std::uint32_t before = *stored.word;
            const std::uint32_t ones = (1u << stored.bits) - 1u;
            const std::uint32_t shift = stored.shift + direction * stored.bits;
            if (((before >> shift) & ones) == ones) continue;
            *stored.word = before + (1u << shift);
            const test::CellBox box =
                test::box_of(local, stored.log2, *stored.word >> stored.shift, stored.bits);
            if (filled.in_box(box.low, box.high) > 0) {
                ++raised;
                ASSERT_NE(test::first_lie(world, filled, built), "") << "filling " << filling;
            }
            *stored.word = before;
        }
    }
    const bool has_boxes = !growing_levels(GetParam()).empty();
    EXPECT_GT(raised, has_boxes ? 100 : -1);
}

TEST_P(EmptyBoxes, one_voxel_more_or_less_than_the_structure_has_is_caught) {
    std::mt19937 dice(kBoxesSeed + 3);
    for (int filling = 0; filling < 20; ++filling) {
        VoxelWorld world = random_filling(dice);
        const MarchWorld built = build_march_world(world, GetParam());
        const glm::ivec3 at(glm::uvec3(dice(), dice(), dice()) % glm::uvec3(world.size()));
        world.set(at, static_cast<std::uint16_t>(4 + filling));  // a material that no other voxel has
        ASSERT_NE(test::first_lie(world, test::FilledCount(world), built), "");
    }
}

INSTANTIATE_TEST_SUITE_P(Structure, EmptyBoxes, ::testing::ValuesIn(all_traversals()), test::traversal_name);
INSTANTIATE_TEST_SUITE_P(Structure, EmptyBoxesNightly, ::testing::ValuesIn(all_traversals()),
                         test::traversal_name);

// Mean distance of the empty cells over all directions; `distance(cell, direction)`.
template <class Distance>
double mean_distance(const std::vector<std::uint8_t>& filled, const Distance& distance) {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < filled.size(); ++i) {
        if (filled[i] != 0) continue;
        for (std::uint32_t direction = 0; direction < 6; ++direction)
            sum += distance(i, direction);
        count += 6.0;
    }
    return sum / count;
}

// Means of both ways to grow boxes over the same roots: by joining boxes, and cell by cell.
std::array<double, 2> both_means(const VoxelWorld& world, Traversal traversal) {
    const MarchWorld built = build_march_world(world, traversal);
    const int log2 = gpu::root_log2(static_cast<gpu::uint>(traversal));
    const glm::ivec3 grid = built.size() >> log2;
    std::vector<std::uint32_t> cells(built.roots.size());  // x fastest
    for (std::uint32_t i = 0; i < cells.size(); ++i)
        cells[i] = built.roots[gpu::root_index(gpu::grid_cell(i, grid) << log2, built.chunks_size, log2)];
    std::vector<std::uint8_t> filled(cells.size());
    std::ranges::transform(cells, filled.begin(), [](std::uint32_t cell) {
        return static_cast<std::uint8_t>(gpu::cell_state(cell) != gpu::kCellEmpty);
    });
    const std::vector<Extents> grown =
        grow_aadf(grid, filled, static_cast<int>(gpu::kDistanceOnes), Beyond::empty);
    return {
        mean_distance(filled,
                      [&](std::size_t i, std::uint32_t direction) {
                          return gpu::distance_towards(gpu::cell_payload(cells[i]), direction);
                      }),
        mean_distance(filled, [&](std::size_t i, std::uint32_t direction) { return grown[i][direction]; })};
}

// Growing cell by cell (as in the paper) is the yardstick. Joined boxes may be a little shorter or longer.
TEST(RootBoxes, are_on_average_as_long_as_boxes_grown_cell_by_cell) {
    constexpr double kShare = 0.95;
    std::mt19937 dice(kBoxesSeed + 4);
    for (const int one_in : {3000, 300, 60}) {
        VoxelWorld world(glm::ivec3(0), glm::ivec3(7, 6, 5));
        for (int i = 0; i < 7 * 6 * 5 * 4096 / one_in / 16; ++i) {
            const auto z = dice(), y = dice(), x = dice();  // in an order that is the same everywhere
            world.set(glm::ivec3(glm::uvec3(x, y, z) % glm::uvec3(world.size())), 1);
        }
        for (const Traversal traversal : all_traversals()) {
            if (growing_levels(traversal).empty()) continue;
            const auto [joined, by_cell] = both_means(world, traversal);
            RecordProperty(std::string(name_of(traversal)) + std::to_string(one_in),
                           std::to_string(joined / by_cell));
            EXPECT_GT(joined, kShare * by_cell) << name_of(traversal) << ", one cell in " << one_in;
        }
    }
}

}  // namespace
}  // namespace voxilux
