#include "world/voxel_world.h"

#include "base/error.h"
#include "shared/world_cell.h"

namespace voxilux {

namespace {

std::uint16_t solid_voxel(std::uint16_t material) {
    return static_cast<std::uint16_t>(gpu::kVoxelSolidBit | material);
}

template <class Visit>
void for_each_cell(const Box& box, const Visit& visit) {
    for (int z = box.lo.z; z < box.hi.z; ++z)
        for (int y = box.lo.y; y < box.hi.y; ++y)
            for (int x = box.lo.x; x < box.hi.x; ++x)
                visit(glm::ivec3(x, y, z));
}

}  // namespace

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

std::uint32_t& VoxelWorld::brick_slot(glm::ivec3 brick_cell) {
    std::uint32_t& slot = chunk_slots_[chunk_index(brick_cell >> (gpu::kChunkLog2 - gpu::kBrickLog2))];
    if (slot == kNoBrick) {
        slot = static_cast<std::uint32_t>(chunk_bricks_.size());
        chunk_bricks_.emplace_back().fill(kNoBrick);
    }
    return chunk_bricks_[slot][gpu::child_slot(brick_cell & 3)];
}

std::uint32_t VoxelWorld::add_brick(const Brick& brick, bool is_shared) {
    bricks_.push_back(brick);
    is_shared_.push_back(is_shared);
    return static_cast<std::uint32_t>(bricks_.size() - 1);
}

VoxelWorld::Brick& VoxelWorld::own_brick(std::uint32_t& number) {
    if (number == kNoBrick) {
        number = add_brick({}, false);
    } else if (is_shared_[number]) {
        number = add_brick(Brick(bricks_[number]), false);
    }
    return bricks_[number];
}

std::uint32_t VoxelWorld::shared_brick(const Box& part, std::uint16_t voxel) {
    const std::uint32_t key =
        std::uint32_t{voxel} << 12 | gpu::child_slot(part.hi - 1) << 6 | gpu::child_slot(part.lo);
    const auto [known, is_new] = shared_.try_emplace(key);
    if (is_new) {
        Brick brick{};
        for_each_cell(part, [&](glm::ivec3 cell) { brick[gpu::child_slot(cell)] = voxel; });
        known->second = add_brick(brick, true);
    }
    return known->second;
}

void VoxelWorld::write(Brick& brick, glm::ivec3 cell, std::uint16_t voxel) {
    std::uint16_t& old = brick[gpu::child_slot(cell)];
    if (old == kEmpty) ++voxel_count_;
    old = voxel;
}

void VoxelWorld::set(glm::ivec3 local, std::uint16_t material) {
    VX_ASSERT(contains(local));
    VX_ASSERT(material <= gpu::kVoxelPayloadMask);
    write(own_brick(brick_slot(local >> gpu::kBrickLog2)), local & 3, solid_voxel(material));
}

void VoxelWorld::fill(const Box& local, std::uint16_t material) {
    VX_ASSERT(!local.empty() && contains(local.lo) && contains(local.hi - 1));
    VX_ASSERT(material <= gpu::kVoxelPayloadMask);
    const std::uint16_t voxel = solid_voxel(material);
    for_each_cell({local.lo >> 2, ((local.hi - 1) >> 2) + 1}, [&](glm::ivec3 brick_cell) {
        const Box part{glm::max(local.lo - brick_cell * 4, 0), glm::min(local.hi - brick_cell * 4, 4)};
        std::uint32_t& number = brick_slot(brick_cell);
        if (number == kNoBrick) {
            number = shared_brick(part, voxel);
            voxel_count_ += static_cast<std::uint64_t>(part.volume());
            return;
        }
        Brick& brick = own_brick(number);
        for_each_cell(part, [&](glm::ivec3 cell) { write(brick, cell, voxel); });
    });
}

void VoxelWorld::put(glm::ivec3 local, std::uint16_t voxel) {
    if (voxel != kEmpty) {
        set(local, voxel & gpu::kVoxelPayloadMask);
    } else if (get(local) != kEmpty) {
        own_brick(brick_slot(local >> gpu::kBrickLog2))[gpu::child_slot(local & 3)] = kEmpty;
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

WorldGrid grid_around(const Box& box, std::uint64_t limit_chunks) {
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

}  // namespace voxilux
