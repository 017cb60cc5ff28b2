#include "voxelizer/index_grid.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "voxelizer/greedy_mesh.h"
#include "voxelizer/vox_output.h"

namespace voxilux {
namespace {

std::size_t index_of(glm::ivec3 cell, glm::ivec3 size) {
    return (static_cast<std::size_t>(cell.x) * static_cast<std::size_t>(size.y) +
            static_cast<std::size_t>(cell.y)) *
               static_cast<std::size_t>(size.z) +
           static_cast<std::size_t>(cell.z);
}

// The cells of a box of at most 256^3 from `corner` on.
VoxModel model_of_part(glm::ivec3 corner, glm::ivec3 size, std::span<const std::uint8_t> indices) {
    VoxModel model{.size = glm::min(size - corner, glm::ivec3(kVoxMaxSide))};
    for (int x = 0; x < model.size.x; ++x)
        for (int y = 0; y < model.size.y; ++y) {
            const auto row = indices.subspan(index_of(corner + glm::ivec3(x, y, 0), size),
                                             static_cast<std::size_t>(model.size.z));
            for (int z = 0; z < model.size.z; ++z) {
                const std::uint8_t index = row[static_cast<std::size_t>(z)];
                if (index == 0) continue;
                model.voxels.push_back({static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y),
                                        static_cast<std::uint8_t>(z), index});
            }
        }
    return model;
}

void check_place(glm::ivec3 low, glm::ivec3 size) {
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t first = low[axis], last = first + size[axis];
        if (std::max(-first, last) <= kVoxMaxTranslation) continue;
        throw Error(ExitCode::input_refused, fmt::format("the voxels reach from {} to {}, beyond {}", first,
                                                         last - 1, kVoxMaxTranslation));
    }
}

}  // namespace

IndexGrid index_grid_of(const VoxFile& file) {
    const std::vector<IndexedCell> cells = cells_of_file(file);
    if (cells.empty()) throw Error(ExitCode::input_refused, "there is no voxel");
    glm::ivec3 low = cells.front().cell, high = low;
    for (const IndexedCell& cell : cells) {
        low = glm::min(low, cell.cell);
        high = glm::max(high, cell.cell);
    }
    const glm::dvec3 extent = glm::dvec3(high) - glm::dvec3(low) + 1.0;
    if (extent.x * extent.y * extent.z > static_cast<double>(kMaxGridCells))
        throw Error(ExitCode::out_of_memory, fmt::format("an array of {} x {} x {} cells would have over {}",
                                                         extent.x, extent.y, extent.z, kMaxGridCells));
    IndexGrid grid{.low = low, .size = high - low + 1};
    grid.indices.resize(index_of({grid.size.x, 0, 0}, grid.size));
    for (const IndexedCell& cell : cells)
        grid.indices[index_of(cell.cell - low, grid.size)] = cell.index;
    return grid;
}

void add_grid(VoxFile& file, glm::ivec3 low, glm::ivec3 size, std::span<const std::uint8_t> indices,
              const std::string& name) {
    check_place(low, size);
    std::vector<PlacedModel> placed;
    for (int x = 0; x < size.x; x += kVoxMaxSide)
        for (int y = 0; y < size.y; y += kVoxMaxSide)
            for (int z = 0; z < size.z; z += kVoxMaxSide) {
                VoxModel model = model_of_part({x, y, z}, size, indices);
                if (model.voxels.empty()) continue;
                placed.push_back({name, low + glm::ivec3(x, y, z), model.size});
                file.models.push_back(std::move(model));
            }
    if (placed.empty()) throw Error(ExitCode::input_refused, "there is no voxel: all are 0");
    add_graph(file, placed, name);
}

}  // namespace voxilux
