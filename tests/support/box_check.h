#pragma once

// Brute force over the cells of a structure: what each cell says about its voxels, and whether its box is
// empty.

#include <string>
#include <vector>

#include "world/march_world.h"

namespace voxilux::test {

// Counts the filled cells of any box of a small world (prefix sums along three axes).
class FilledCount {
  public:
    explicit FilledCount(const VoxelWorld& world);

    // Filled cells of low <= c < high; what lies outside the world is empty.
    [[nodiscard]] int in_box(glm::ivec3 low, glm::ivec3 high) const;

  private:
    [[nodiscard]] std::size_t index(glm::ivec3 c) const;

    glm::ivec3 size_;
    std::vector<int> below_;  // filled cells with smaller coordinates on every axis
};

// What is wrong with the first wrong cell: an empty cell that is not empty, a box that holds a voxel, a solid
// cell of another material, children that disagree. Empty when all cells are right.
[[nodiscard]] std::string first_lie(const VoxelWorld& world, const FilledCount& filled,
                                    const MarchWorld& built);

// Where the distances of the empty cell at `local` are stored.
struct StoredDistances {
    std::uint32_t* word = nullptr;  // null when the structure stores none for such cells
    std::uint32_t shift = 0;
    std::uint32_t bits = 0;  // of one distance
    int log2 = 0;            // edge of the cell in voxels
};
[[nodiscard]] StoredDistances stored_distances(MarchWorld& built, glm::ivec3 local);

// Cells [low, high) of the box of an empty cell of edge 2^log2 at `local` with these six distances.
struct CellBox {
    glm::ivec3 low;
    glm::ivec3 high;
};
[[nodiscard]] CellBox box_of(glm::ivec3 local, int log2, std::uint32_t distances, std::uint32_t bits);

}  // namespace voxilux::test
