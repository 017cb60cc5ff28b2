#pragma once

// The march's contract executed plainly on the voxels: crossings in the order (time, axis), one cell at a
// time, no structure. Its times are those of the march.

#include <array>
#include <vector>

#include "world/voxel_world.h"
#include "world/world_view.h"

namespace voxilux::test {

// The order of axes in which planes are crossed that a ray meets at the same time.
using AxisOrder = std::array<int, 3>;
inline constexpr AxisOrder kTieRule = {0, 1, 2};

[[nodiscard]] gpu::MarchHit walk_cells(const VoxelWorld& world, const gpu::Ray& ray,
                                       AxisOrder order = kTieRule);

// The voxels of a small world in one array, for walks by the million.
class DenseVoxels {
  public:
    explicit DenseVoxels(const VoxelWorld& world);

    [[nodiscard]] glm::ivec3 size() const { return size_; }
    [[nodiscard]] bool contains(glm::ivec3 c) const { return !gpu::is_outside(c, size_); }
    // As VoxelWorld::get, for cells inside.
    [[nodiscard]] std::uint16_t get(glm::ivec3 c) const { return voxels_[gpu::grid_index(c, size_)]; }

  private:
    glm::ivec3 size_;
    std::vector<std::uint16_t> voxels_;
};

[[nodiscard]] gpu::MarchHit walk_cells(const DenseVoxels& world, const gpu::Ray& ray,
                                       AxisOrder order = kTieRule);

}  // namespace voxilux::test
