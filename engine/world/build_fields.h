#pragma once

#include <cstdint>
#include <vector>

#include "shared/gpu_types.h"
#include "world/march_world.h"

namespace voxilux {

// Fills the arrays of `built`, whose traversal (one with boxes) and size are set, as world_cell.h says,
// except for the boxes that grow afterwards: their distances are 0. Equal mixed bricks are stored once.
void build_unexpanded(const VoxelWorld& world, MarchWorld& built);

// log2 of the cell edges, in voxels, of the levels whose boxes grow, in the order they must grow in.
[[nodiscard]] std::vector<int> growing_levels(Traversal traversal);

// The cells of such a level.
[[nodiscard]] std::vector<std::uint32_t>& level_words(MarchWorld& built, int log2);
[[nodiscard]] const std::vector<std::uint32_t>& level_words(const MarchWorld& built, int log2);

// For each block of 64 cells of a level, the cell of its parent; empty for chunks, which have no blocks.
[[nodiscard]] std::vector<glm::ivec3> level_homes(const MarchWorld& built, int log2);

// Grows the boxes of all levels of an unexpanded structure, step by step.
class BoxGrowth {
  public:
    explicit BoxGrowth(MarchWorld& built) : built_(&built), levels_(growing_levels(built.traversal)) {}

    // Takes the next step; false when there is none.
    bool step();

  private:
    void begin_level();

    MarchWorld* built_;
    std::vector<int> levels_;
    std::size_t level_ = 0;
    gpu::uint number_ = 0;  // of the next step in the level
    std::vector<glm::ivec3> homes_;
    std::vector<std::uint32_t> grown_;
};

// Takes all steps.
void grow_boxes(MarchWorld& built);

// A level with cells whose boxes grow.
struct GrowingLevel {
    int log2 = 0;
    std::uint64_t cells = 0;

    bool operator==(const GrowingLevel&) const = default;
};

// What the distance-field build on the device needs for an unexpanded structure: bytes of scratch buffers,
// and the levels, in the order they grow in.
struct GrowthNeeds {
    std::uint64_t home_bytes = 0;
    std::uint64_t grown_bytes = 0;
    std::vector<GrowingLevel> levels;

    bool operator==(const GrowthNeeds&) const = default;
};
[[nodiscard]] GrowthNeeds growth_needs(const MarchWorld& unexpanded);

}  // namespace voxilux
