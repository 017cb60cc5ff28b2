#include "formats/voxel_cells.h"

#include <algorithm>

#include "base/file.h"
#include "formats/vox_bytes.h"

namespace voxilux {
namespace {

constexpr VoxelFormat kVoxelFormats[] = {
    {".qb", read_qb},         {".kv6", read_kv6},     {".vxl", read_vxl},
    {".binvox", read_binvox}, {".schem", read_schem}, {".litematic", read_litematic},
};

// Empty files and those that spread too far would fail later, without an offset.
void check_cells(const VoxelCells& voxels, std::size_t size) {
    if (voxels.cells.empty()) throw VoxRefusal(size, "the file has no voxel");
    glm::ivec3 low = voxels.cells.front().cell, high = low;
    for (const ColouredCell& voxel : voxels.cells) {
        low = glm::min(low, voxel.cell);
        high = glm::max(high, voxel.cell);
    }
    const glm::i64vec3 extent = glm::i64vec3(high) - glm::i64vec3(low) + std::int64_t{1};
    if (std::max({extent.x, extent.y, extent.z}) > kMaxCellSide)
        throw VoxRefusal(size, fmt::format("the voxels spread over {} x {} x {} cells, more than {}",
                                           extent.x, extent.y, extent.z, kMaxCellSide));
}

}  // namespace

std::span<const VoxelFormat> voxel_formats() {
    return kVoxelFormats;
}

const VoxelFormat* voxel_format_of(const std::filesystem::path& file) {
    const auto found = std::ranges::find_if(
        kVoxelFormats, [&](const VoxelFormat& format) { return has_ending(file, format.ending); });
    return found == std::end(kVoxelFormats) ? nullptr : found;
}

void add_cell(VoxelCells& into, std::size_t most, const ColouredCell& cell, std::size_t offset) {
    if (into.cells.size() >= most) throw VoxRefusal(offset, fmt::format("there are over {} voxels", most));
    into.cells.push_back(cell);
}

Result<VoxelCells> read_voxel_cells(const VoxelFormat& format, std::span<const std::byte> bytes,
                                    std::size_t most) {
    VoxelCells voxels;
    try {
        format.read(bytes, most, voxels);
        check_cells(voxels, bytes.size());
    } catch (const VoxRefusal& refusal) {
        return Failure{refusal.what()};
    }
    return voxels;
}

}  // namespace voxilux
