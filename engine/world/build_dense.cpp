#include "world/build_dense.h"

#include <algorithm>

#include "base/checked_cast.h"
#include "base/error.h"
#include "shared/world_cell.h"

namespace voxilux {
namespace {

void put_half(std::vector<std::uint32_t>& words, std::size_t i, std::uint32_t half) {
    words[i / 2] |= half << (16 * (i % 2));
}

// Packs one root cell of a masked structure. The voxels of a mixed one are appended to nodes and leaves.
std::uint32_t pack_masked(const VoxelWorld& world, MarchWorld& built, glm::ivec3 corner, int edge) {
    const auto count = static_cast<std::size_t>(edge) * static_cast<std::size_t>(edge * edge);
    std::vector<std::uint16_t> voxels;
    voxels.reserve(count);
    for (int z = 0; z < edge; ++z)
        for (int y = 0; y < edge; ++y)
            for (int x = 0; x < edge; ++x)
                voxels.push_back(world.get(corner + glm::ivec3(x, y, z)));
    const bool is_uniform = std::ranges::all_of(voxels, [&](std::uint16_t v) { return v == voxels[0]; });
    if (is_uniform && voxels[0] == VoxelWorld::kEmpty) return gpu::make_cell(gpu::kCellEmpty, 0);
    if (is_uniform) return gpu::make_cell(gpu::kCellSolid, voxels[0] & gpu::kVoxelPayloadMask);
    const std::size_t number = built.nodes.size() / (count / 32);
    built.nodes.resize(built.nodes.size() + count / 32);
    built.leaves.resize(built.leaves.size() + count / 2);
    for (std::size_t i = 0; i < count; ++i) {
        if (voxels[i] == VoxelWorld::kEmpty) continue;
        const std::size_t voxel = number * count + i;
        built.nodes[voxel / 32] |= 1u << (voxel % 32);
        put_half(built.leaves, voxel, voxels[i] & gpu::kVoxelPayloadMask);
    }
    return gpu::make_cell(gpu::kCellMixed, checked_cast<std::uint32_t>(number, "mixed bricks"));
}

}  // namespace

void build_bytes(const VoxelWorld& world, MarchWorld& built) {
    const glm::ivec3 size = world.size();
    const auto count = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                       static_cast<std::size_t>(size.z);
    built.leaves.assign(count / 4, 0);
    world.for_each_voxel([&](glm::ivec3 local, std::uint16_t voxel) {
        const std::uint32_t material = voxel & gpu::kVoxelPayloadMask;
        if (material >= gpu::kByteMaterials) {
            throw Error(
                ExitCode::out_of_memory,
                fmt::format(
                    "traversal 'dda' holds a byte per voxel: {} materials at most, the scene has more",
                    gpu::kByteMaterials));
        }
        const std::uint32_t i = gpu::grid_index(local, size);
        built.leaves[i / 4] |= (material + 1) << (8 * (i % 4));
    });
}

void build_masks(const VoxelWorld& world, MarchWorld& built) {
    const int log2 = gpu::root_log2(static_cast<gpu::uint>(built.traversal));
    const int edge = 1 << log2;
    const int per_chunk = 1 << (gpu::kChunkLog2 - log2);
    const glm::ivec3 grid = world.size() >> log2;
    built.roots.assign(static_cast<std::size_t>(grid.x) * static_cast<std::size_t>(grid.y) *
                           static_cast<std::size_t>(grid.z),
                       gpu::make_cell(gpu::kCellEmpty, 0));
    world.for_each_chunk([&](glm::ivec3 chunk_cell, const VoxelWorld::ChunkBricks&) {
        for (int z = 0; z < per_chunk; ++z)
            for (int y = 0; y < per_chunk; ++y)
                for (int x = 0; x < per_chunk; ++x) {
                    const glm::ivec3 cell = chunk_cell * per_chunk + glm::ivec3(x, y, z);
                    built.roots[gpu::root_index(cell * edge, built.chunks_size, log2)] =
                        pack_masked(world, built, cell * edge, edge);
                }
    });
}

}  // namespace voxilux
