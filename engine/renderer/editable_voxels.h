#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scene/facts.h"
#include "world/edit_world.h"

namespace voxilux {

// A box of scene cells that gets one material, or air.
struct BoxEdit {
    Box box;
    std::optional<std::uint32_t> material;  // of the scene; nothing: air
    bool paints = false;                    // changes voxels that exist, not air

    bool operator==(const BoxEdit&) const = default;
};

// What an edit has changed.
struct VoxelChange {
    bool has_moved = false;        // the voxels have another grid now
    std::vector<VoxelEdit> cells;  // changed ones; of no use where has_moved
    std::vector<BoxEdit> back;     // edits that undo all of it, in this order
};

// The voxels of an edited scene, and their facts. Their grid is always the one that a scene with just these
// voxels would have.
class EditableVoxels {
  public:
    explicit EditableVoxels(const Scene& scene);

    // Throws Error(input_refused) for a box beyond kMaxCoordinate or a material that the scene lacks, and
    // Error(out_of_memory) for a grid that is too large; then nothing is changed.
    VoxelChange apply(std::span<const BoxEdit> edits);

    [[nodiscard]] VoxelWorld& world() { return world_; }
    [[nodiscard]] const VoxelWorld& world() const { return world_; }
    [[nodiscard]] VoxelFacts facts() const;

  private:
    void check(const BoxEdit& edit) const;
    void put(glm::ivec3 local, std::uint16_t voxel, VoxelChange& change);
    void move_to(const WorldGrid& grid);
    void measure_box();

    VoxelWorld world_;
    std::vector<std::uint64_t> counts_;  // of voxels, by material
    Box box_;
    bool may_shrink_ = false;  // a voxel at the border of the box was cleared
};

}  // namespace voxilux
