#include "voxelizer/cell_set.h"

#include <algorithm>
#include <utility>

#include "base/assert.h"
#include "voxelizer/bin_triangles.h"
#include "voxelizer/surface_look.h"

namespace voxilux {
namespace {

// The order of a VoxelSet: by model, then by block, then by cell.
std::uint64_t order_of(glm::ivec3 cell, glm::ivec3 cells) {
    const auto packed = [](glm::ivec3 c, int side) {
        return static_cast<std::uint64_t>((c.z * side + c.y) * side + c.x);
    };
    constexpr int kBlocks = kModelCells / kBlockCells;
    const std::uint64_t model = model_of(cell, cells);
    return (model << 6 | packed(cell % kModelCells / kBlockCells, kBlocks)) << 18 |
           packed(cell % kBlockCells, kBlockCells);
}

// Glass and water let most light through; a light is four times as bright as its colour under a plain sky.
std::uint16_t look_bits(CellLook look) {
    constexpr std::uint8_t kMostlyClear = 12, kGlassIor = 5, kWaterIor = 3, kFourfold = 14;
    switch (look) {
        case CellLook::diffuse:
            return packed({});
        case CellLook::glass:
            return packed({.kind = LookKind::glass, .level = kMostlyClear, .ior = kGlassIor});
        case CellLook::water:
            return packed({.kind = LookKind::glass, .level = kMostlyClear, .ior = kWaterIor});
        case CellLook::light:
            return packed({.kind = LookKind::emit, .level = kFourfold});
    }
    VX_ASSERT(false);
}

void sort_cells(std::vector<ColouredCell>& voxels, glm::ivec3 cells) {
    const auto before = [&](const ColouredCell& a, const ColouredCell& b) {
        return order_of(a.cell, cells) < order_of(b.cell, cells);
    };
    if (!std::ranges::is_sorted(voxels, before)) std::ranges::stable_sort(voxels, before);
}

}  // namespace

VoxelSet voxel_set_of(VoxelCells&& given) {
    std::vector<ColouredCell> voxels = std::move(given.cells);
    glm::ivec3 low = voxels.front().cell, high = low;
    for (const ColouredCell& voxel : voxels) {
        low = glm::min(low, voxel.cell);
        high = glm::max(high, voxel.cell);
    }
    VoxelSet set{.grid = {.low = glm::dvec3(low), .cells = high - low + 1, .origin = -low}};
    for (ColouredCell& voxel : voxels)
        voxel.cell -= low;
    sort_cells(voxels, set.grid.cells);
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        const auto [cell, colour, look] = voxels[i];
        if (i + 1 < voxels.size() && voxels[i + 1].cell == cell) continue;
        const glm::ivec3 block = cell / kBlockCells * kBlockCells;
        if (set.blocks.empty() || set.blocks.back().low != block)
            set.blocks.push_back({.low = block, .model = model_of(cell, set.grid.cells)});
        const glm::u8vec3 at(cell % kModelCells);
        set.blocks.back().surface.push_back(
            {at.x, at.y, at.z, colour.r, colour.g, colour.b, look_bits(look)});
        ++set.surface;
    }
    return set;
}

}  // namespace voxilux
