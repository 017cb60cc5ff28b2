// Boxes that are cut where voxels have been filled, against all single cuts.

#include "world/cut_box.h"

#include <gtest/gtest.h>

#include <random>

#include "shared/aadf.h"

namespace voxilux {
namespace {

using Distances = std::array<int, 6>;

gpu::uint packed(const Distances& distances) {
    gpu::uint packed = 0;
    for (gpu::uint i = 0; i < 6; ++i)
        packed |= static_cast<gpu::uint>(distances[i]) << (gpu::kFarBits * i);
    return packed;
}

Distances unpacked(gpu::uint distances) {
    Distances all;
    for (gpu::uint i = 0; i < 6; ++i)
        all[i] = static_cast<int>(gpu::distance_towards(distances, i));
    return all;
}

CellBounds box_of(glm::ivec3 cell, const Distances& d) {
    return {cell - glm::ivec3(d[0], d[2], d[4]), cell + glm::ivec3(d[1], d[3], d[5]) + 1};
}

bool meet(const CellBounds& a, const CellBounds& b) {
    return !CellBounds{glm::max(a.low, b.low), glm::min(a.high, b.high)}.empty();
}

// The largest box that keeps clear after one of the distances is shortened; 0 cells where none does.
std::int64_t most_cells(const Distances& distances, glm::ivec3 cell, const CellBounds& filled) {
    std::int64_t most = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        Distances cut = distances;
        for (; cut[i] >= 0; --cut[i]) {
            const CellBounds box = box_of(cell, cut);
            if (!meet(box, filled)) most = std::max(most, box.count());
        }
    }
    return most;
}

TEST(CutBox, random_boxes_keep_clear_and_lose_the_least) {
    std::mt19937 dice(2027);
    const auto below = [&](int n) { return static_cast<int>(dice() % static_cast<unsigned>(n)); };
    int inside = 0;
    int cuts = 0;
    for (int i = 0; i < 20000; ++i) {
        Distances distances;
        for (int& distance : distances)
            distance = below(i % 2 == 0 ? 8 : 32);
        const glm::ivec3 cell(below(20), below(20), below(20));
        const glm::ivec3 low(below(20), below(20), below(20));
        const CellBounds filled{low, low + 1 + glm::ivec3(below(9), below(9), below(9))};
        const Distances cut = unpacked(cut_distances(packed(distances), cell, filled));
        if (filled.contains(cell)) {
            ++inside;
            EXPECT_EQ(cut, Distances{});
            continue;
        }
        for (std::size_t k = 0; k < 6; ++k)
            EXPECT_LE(cut[k], distances[k]);
        EXPECT_FALSE(meet(box_of(cell, cut), filled));
        EXPECT_EQ(box_of(cell, cut).count(), most_cells(distances, cell, filled));
        cuts += cut != distances ? 1 : 0;
    }
    EXPECT_GT(inside, 100);
    EXPECT_GT(cuts, 1000);
}

TEST(CutBox, judge_sees_a_box_that_was_not_cut) {
    const CellBounds filled{{5, 0, 0}, {6, 1, 1}};
    EXPECT_TRUE(meet(box_of({0, 0, 0}, {0, 5, 0, 0, 0, 0}), filled));
    EXPECT_EQ(unpacked(cut_distances(packed({0, 5, 0, 0, 0, 0}), {0, 0, 0}, filled))[1], 4);
}

}  // namespace
}  // namespace voxilux
