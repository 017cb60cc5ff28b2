#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scene/vox_file.h"

namespace voxilux {

// Palette indices of a box of cells, as arrays of other programs hold them: [x][y][z], z fastest. 0 is empty.
struct IndexGrid {
    glm::ivec3 low{0};  // the cell of the first
    glm::ivec3 size{0};
    std::vector<std::uint8_t> indices;
};

// Most cells of a grid: 4 GiB.
inline constexpr std::uint64_t kMaxGridCells = std::uint64_t{1} << 32;

// The voxels of all visible instances at frame 0, in the smallest box. Throws Error(input_refused) as
// cells_of_file does and for a file without voxels, Error(out_of_memory) beyond kMaxGridCells.
[[nodiscard]] IndexGrid index_grid_of(const VoxFile& file);

// Adds the voxels to a file without models: models of at most 256^3, each in a group called `name`. `indices`
// has as many elements as the box has cells. Throws Error(input_refused) when all are 0, and for a cell
// beyond kVoxMaxTranslation.
void add_grid(VoxFile& file, glm::ivec3 low, glm::ivec3 size, std::span<const std::uint8_t> indices,
              const std::string& name);

}  // namespace voxilux
