#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "world/build_fields.h"
#include "world/march_world.h"
#include "world/word_range.h"

namespace voxilux {

struct VoxelEdit {
    glm::ivec3 local{0};      // inside the world
    std::uint16_t voxel = 0;  // 16 bits as VoxelWorld::get gives them: kEmpty clears the cell
};

// Where words may have changed, ascending.
struct WorldChanges {
    bool is_rebuilt = false;       // all of them
    bool has_stale_boxes = false;  // some boxes may be smaller than in a structure built anew
    std::vector<WordRange> roots;
    std::vector<WordRange> nodes;
    std::vector<WordRange> leaves;
};

// Sets and clears voxels in a world and in its structure. Afterwards a march gives the hits of the edited
// world, and Regrowth makes every cell and every box what build_march_world would make of it; blocks of
// leaves may be numbered differently, and unused ones stay. For wide and deep, an edit costs little: boxes
// that reach into what was filled are cut, and what was cleared gets boxes from the cells around it. The
// other structures are built anew.
WorldChanges edit_world(VoxelWorld& world, MarchWorld& built, std::span<const VoxelEdit> edits);

// Grows the boxes of an edited structure again, in steps of some milliseconds.
class Regrowth {
  public:
    explicit Regrowth(const MarchWorld& built);
    Regrowth(const Regrowth&) = delete;
    Regrowth& operator=(const Regrowth&) = delete;

    // Takes one step; false when none is left.
    bool step() { return growth_->step(); }

    // Takes all steps that are left and gives `built`, which must not have changed since, the boxes.
    WorldChanges finish(MarchWorld& built);

  private:
    MarchWorld grown_;  // without leaves
    std::optional<BoxGrowth> growth_;
};

}  // namespace voxilux
