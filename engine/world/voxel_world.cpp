#include "world/voxel_world.h"

#include "base/error.h"
#include "shared/world_cell.h"

namespace voxilux {

VoxelWorld::VoxelWorld(glm::ivec3 origin, glm::ivec3 chunks) : origin_(origin), chunks_(chunks) {
    VX_ASSERT(chunks.x > 0 && chunks.y > 0 && chunks.z > 0);
    const auto count = static_cast<std::size_t>(chunks.x) * static_cast<std::size_t>(chunks.y) *
                       static_cast<std::size_t>(chunks.z);
    chunk_slots_.assign(count, kNoBrick);
}

bool VoxelWorld::contains(glm::ivec3 local) const {
    const glm::ivec3 s = size();
    return local.x >= 0 && local.y >= 0 && local.z >= 0 && local.x < s.x && local.y < s.y && local.z < s.z;
}

std::size_t VoxelWorld::chunk_index(glm::ivec3 c) const {
    return static_cast<std::size_t>(c.x) +
           static_cast<std::size_t>(chunks_.x) *
               (static_cast<std::size_t>(c.y) +
                static_cast<std::size_t>(chunks_.y) * static_cast<std::size_t>(c.z));
}

void VoxelWorld::set(glm::ivec3 local, std::uint16_t material) {
    VX_ASSERT(contains(local));
    VX_ASSERT(material <= gpu::kVoxelPayloadMask);
    std::uint32_t& slot = chunk_slots_[chunk_index(local >> gpu::kChunkLog2)];
    if (slot == kNoBrick) {
        slot = static_cast<std::uint32_t>(chunk_bricks_.size());
        chunk_bricks_.emplace_back().fill(kNoBrick);
    }
    std::uint32_t& number = chunk_bricks_[slot][gpu::child_slot((local >> gpu::kBrickLog2) & 3)];
    if (number == kNoBrick) {
        number = static_cast<std::uint32_t>(bricks_.size());
        bricks_.emplace_back().fill(kEmpty);
    }
    std::uint16_t& voxel = bricks_[number][gpu::child_slot(local & 3)];
    if (voxel == kEmpty) ++voxel_count_;
    voxel = static_cast<std::uint16_t>(gpu::kVoxelSolidBit | material);
}

void VoxelWorld::put(glm::ivec3 local, std::uint16_t voxel) {
    if (voxel != kEmpty) {
        set(local, voxel & gpu::kVoxelPayloadMask);
    } else if (get(local) != kEmpty) {
        const std::uint32_t number =
            (*chunk(local >> gpu::kChunkLog2))[gpu::child_slot((local >> gpu::kBrickLog2) & 3)];
        bricks_[number][gpu::child_slot(local & 3)] = kEmpty;
        --voxel_count_;
    }
}

std::uint16_t VoxelWorld::get(glm::ivec3 local) const {
    if (!contains(local)) return kEmpty;
    const ChunkBricks* bricks = chunk(local >> gpu::kChunkLog2);
    if (bricks == nullptr) return kEmpty;
    const std::uint32_t number = (*bricks)[gpu::child_slot((local >> gpu::kBrickLog2) & 3)];
    return number == kNoBrick ? kEmpty : bricks_[number][gpu::child_slot(local & 3)];
}

const VoxelWorld::ChunkBricks* VoxelWorld::chunk(glm::ivec3 chunk_cell) const {
    const std::uint32_t slot = chunk_slots_[chunk_index(chunk_cell)];
    return slot == kNoBrick ? nullptr : &chunk_bricks_[slot];
}

std::uint32_t VoxelWorld::brick_number(glm::ivec3 brick_cell) const {
    if (!contains(brick_cell * 4)) return kNoBrick;
    const ChunkBricks* bricks = chunk(brick_cell >> 2);
    return bricks == nullptr ? kNoBrick : (*bricks)[gpu::child_slot(brick_cell & 3)];
}

VoxelGrid grid_around(const Box& box, std::uint64_t limit_chunks) {
    if (box.empty()) return {};
    const glm::ivec3 origin = box.lo - 1;
    const glm::ivec3 chunks = (box.hi + 1 - origin + 15) >> gpu::kChunkLog2;
    const std::uint64_t count = static_cast<std::uint64_t>(chunks.x) * static_cast<std::uint64_t>(chunks.y) *
                                static_cast<std::uint64_t>(chunks.z);
    if (count > limit_chunks) {
        throw Error(
            ExitCode::out_of_memory,
            fmt::format("the voxels span {} x {} x {} cells: {} chunks of 16^3, over the limit of {}; move "
                        "the models closer together",
                        chunks.x * 16, chunks.y * 16, chunks.z * 16, count, limit_chunks));
    }
    return {origin, chunks};
}

VoxelWorld build_world(const Scene& scene, std::uint64_t limit_chunks) {
    const VoxelGrid grid = grid_around(voxel_bounds(scene), limit_chunks);
    VoxelWorld world(grid.origin, grid.chunks);
    for (const Instance& instance : scene.instances) {
        const VoxelModel& model = scene.models[instance.model];
        for (const Voxel& voxel : model.voxels)
            world.set(world_cell(instance, model.size, {voxel.x, voxel.y, voxel.z}) - grid.origin,
                      voxel.material);
    }
    return world;
}

}  // namespace voxilux
