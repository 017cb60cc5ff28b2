#pragma once

#include <vector>

#include "scene/vox_file.h"

namespace voxilux {

// A set of cells of one model: one bit for each (x, y, z) up to the highest seen, at most 2 MiB. Made once
// for a file, since forgetting the cells of a model costs only as much as the model.
class VoxCells {
  public:
    // Whether the cell is new; it is in the set afterwards.
    bool insert(const VoxVoxel& voxel) {
        const std::size_t at = slot(voxel);
        if (at >= words_.size()) words_.resize(at + 1);
        std::uint64_t& word = words_[at];
        const std::uint64_t bit = std::uint64_t{1} << (voxel.x & 63);
        const bool is_new = (word & bit) == 0;
        word |= bit;
        return is_new;
    }
    // Empties the set, which must hold no other cells than these.
    void forget(const std::vector<VoxVoxel>& voxels) {
        for (const VoxVoxel& voxel : voxels) {
            if (slot(voxel) < words_.size()) words_[slot(voxel)] = 0;
        }
    }

  private:
    static std::size_t slot(const VoxVoxel& v) {
        return (std::size_t{v.z} << 8 | std::size_t{v.y}) << 2 | std::size_t{v.x} >> 6;
    }
    std::vector<std::uint64_t> words_;
};

[[nodiscard]] bool is_inside(const VoxVoxel& voxel, glm::ivec3 size);

// Sets out_of_size, duplicates and index0 from the voxels. `cells` is empty before and after.
void count_oddities(VoxModel& model, VoxCells& cells);

// Whether some entries mean nothing, by these counts.
[[nodiscard]] bool has_oddities(const VoxModel& model);

// What the model's entries mean: those inside its size, for each cell the last one, without index 0. In file
// order.
[[nodiscard]] std::vector<VoxVoxel> filled_voxels(const VoxModel& model, VoxCells& cells);

}  // namespace voxilux
