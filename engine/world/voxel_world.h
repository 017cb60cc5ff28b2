#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"
#include "scene/scene_bounds.h"

namespace voxilux {

// The voxels of a scene with its instances flattened, stored sparsely by bricks of 4^3. Cells are counted
// from the world's own corner: scene cell = origin + local cell. The grid is whole chunks of 16^3 and keeps
// at least one empty cell around the voxels, so that the cell in front of every face belongs to the world.
class VoxelWorld {
  public:
    static constexpr std::uint16_t kEmpty = 0;

    // An empty world of `chunks` (each > 0) whose local cell 0 is scene cell `origin`.
    VoxelWorld(glm::ivec3 origin, glm::ivec3 chunks);

    // Fills a cell; `material` < 32768. The last call for a cell wins.
    void set(glm::ivec3 local, std::uint16_t material);
    // The same for every cell of a box. Bricks that only this box fills are stored once where it fills the
    // same part of them.
    void fill(const Box& local, std::uint16_t material);

    // Sets a cell to the 16 bits that get() gives: kEmpty clears it.
    void put(glm::ivec3 local, std::uint16_t voxel);

    // The 16 bits of a voxel as world_cell.h has them: 0x8000 | material, or kEmpty. Outside the world all is
    // empty.
    [[nodiscard]] std::uint16_t get(glm::ivec3 local) const;

    [[nodiscard]] glm::ivec3 origin() const { return origin_; }
    [[nodiscard]] glm::ivec3 chunks() const { return chunks_; }
    [[nodiscard]] glm::ivec3 size() const { return chunks_ * 16; }
    [[nodiscard]] std::uint64_t voxel_count() const { return voxel_count_; }
    [[nodiscard]] bool contains(glm::ivec3 local) const;

    using Brick = std::array<std::uint16_t, 64>;        // voxels, x fastest
    using ChunkBricks = std::array<std::uint32_t, 64>;  // brick numbers, kNoBrick where empty
    static constexpr std::uint32_t kNoBrick = 0xFFFFFFFFu;

    // The bricks of a chunk, or null when the chunk is empty.
    [[nodiscard]] const ChunkBricks* chunk(glm::ivec3 chunk_cell) const;
    [[nodiscard]] const Brick& brick(std::uint32_t number) const { return bricks_[number]; }
    [[nodiscard]] std::size_t brick_count() const { return bricks_.size(); }

    // Number of the brick at a cell counted in bricks; kNoBrick where all is empty, outside too.
    [[nodiscard]] std::uint32_t brick_number(glm::ivec3 brick_cell) const;

    // Every chunk that is not empty, x fastest: visit(chunk cell, its bricks).
    template <class Visit>
    void for_each_chunk(const Visit& visit) const {
        for (std::size_t i = 0; i < chunk_slots_.size(); ++i) {
            if (chunk_slots_[i] == kNoBrick) continue;
            const auto number = static_cast<int>(i);
            const glm::ivec3 cell{number % chunks_.x, number / chunks_.x % chunks_.y,
                                  number / chunks_.x / chunks_.y};
            visit(cell, chunk_bricks_[chunk_slots_[i]]);
        }
    }

    // Every filled voxel: visit(local cell, its 16 bits).
    template <class Visit>
    void for_each_voxel(const Visit& visit) const {
        for_each_chunk([&](glm::ivec3 chunk_cell, const ChunkBricks& numbers) {
            for (int slot = 0; slot < 64; ++slot) {
                const std::uint32_t number = numbers[static_cast<std::size_t>(slot)];
                if (number == kNoBrick) continue;
                const glm::ivec3 corner =
                    chunk_cell * 16 + glm::ivec3(slot & 3, (slot >> 2) & 3, slot >> 4) * 4;
                for (int i = 0; i < 64; ++i) {
                    const std::uint16_t voxel = bricks_[number][static_cast<std::size_t>(i)];
                    if (voxel != kEmpty) visit(corner + glm::ivec3(i & 3, (i >> 2) & 3, i >> 4), voxel);
                }
            }
        });
    }

  private:
    friend class Flattening;

    [[nodiscard]] std::size_t chunk_index(glm::ivec3 chunk_cell) const;
    // The slot that holds the number of the brick; its chunk is made where there is none.
    [[nodiscard]] std::uint32_t& brick_slot(glm::ivec3 brick_cell);
    std::uint32_t add_brick(const Brick& brick, bool is_shared);
    // The brick for writing: made where there is none, copied where it is shared.
    [[nodiscard]] Brick& own_brick(std::uint32_t& number);
    [[nodiscard]] std::uint32_t shared_brick(const Box& part, std::uint16_t voxel);
    void write(Brick& brick, glm::ivec3 cell, std::uint16_t voxel);

    glm::ivec3 origin_;
    glm::ivec3 chunks_;
    std::uint64_t voxel_count_ = 0;
    std::vector<std::uint32_t> chunk_slots_;  // dense, kNoBrick where empty
    std::vector<ChunkBricks> chunk_bricks_;
    std::vector<Brick> bricks_;
    std::vector<bool> is_shared_;                              // whether cells share a brick, by its number
    std::unordered_map<std::uint32_t, std::uint32_t> shared_;  // bricks that one box fills, by part and voxel
};

// Where a world lies: the scene cell of its local cell 0, and its chunks.
struct WorldGrid {
    glm::ivec3 origin{0};
    glm::ivec3 chunks{1};

    bool operator==(const WorldGrid&) const = default;
};

inline constexpr std::uint64_t kMaxChunks = std::uint64_t{1} << 25;

// The grid of a world whose voxels fill this box of scene cells. Throws Error(out_of_memory) when it would
// have more than `limit_chunks` chunks.
[[nodiscard]] WorldGrid grid_around(const Box& box, std::uint64_t limit_chunks = kMaxChunks);

// The world of a scene's voxels. Throws as grid_around does.
[[nodiscard]] VoxelWorld build_world(const Scene& scene, std::uint64_t limit_chunks = kMaxChunks);

}  // namespace voxilux
