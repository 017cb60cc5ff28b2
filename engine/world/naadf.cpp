#include "world/naadf.h"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <unordered_map>

#include "base/checked_cast.h"
#include "shared/naadf_cell.h"
#include "world/aadf.h"

namespace voxilux {
namespace {

using Words = std::array<std::uint32_t, 32>;

std::uint32_t pack_distances(const Extents& extents, std::uint32_t bits) {
    std::uint32_t packed = 0;
    for (std::size_t direction = 0; direction < 6; ++direction)
        packed |= static_cast<std::uint32_t>(extents[direction])
                  << (static_cast<std::uint32_t>(direction) * bits);
    return packed;
}

std::uint64_t filled_mask(const VoxelWorld::Brick& brick) {
    std::uint64_t mask = 0;
    for (std::size_t i = 0; i < 64; ++i)
        mask |= static_cast<std::uint64_t>(brick[i] != VoxelWorld::kEmpty) << i;
    return mask;
}

bool is_uniform(const VoxelWorld::Brick& brick) {
    return std::ranges::all_of(brick, [&](std::uint16_t voxel) { return voxel == brick[0]; });
}

Words pack_brick(const VoxelWorld::Brick& brick) {
    const std::array<Extents, 64> extents = grow_aadf_4(filled_mask(brick));
    Words words{};
    for (std::size_t i = 0; i < 64; ++i) {
        const std::uint32_t voxel = brick[i] != VoxelWorld::kEmpty
                                        ? std::uint32_t{brick[i]}
                                        : pack_distances(extents[i], gpu::kInnerDistanceBits);
        words[i / 2] |= voxel << (16 * (i % 2));
    }
    return words;
}

// Appends bricks to the voxel array, each distinct content once.
class BrickStore {
  public:
    explicit BrickStore(std::vector<std::uint32_t>& voxels) : voxels_(voxels) {}

    std::uint32_t add(const VoxelWorld::Brick& brick) {
        const std::string key(reinterpret_cast<const char*>(brick.data()), sizeof(brick));
        const auto number = checked_cast<std::uint32_t>(voxels_.size() / 32, "distinct bricks");
        const auto [known, is_new] = numbers_.try_emplace(key, number);
        if (is_new) {
            const Words words = pack_brick(brick);
            voxels_.insert(voxels_.end(), words.begin(), words.end());
        }
        return known->second;
    }

  private:
    std::vector<std::uint32_t>& voxels_;
    std::unordered_map<std::string, std::uint32_t> numbers_;
};

using BrickCells = std::array<std::uint32_t, 64>;

BrickCells pack_chunk(const VoxelWorld& world, const VoxelWorld::ChunkBricks& numbers, BrickStore& store) {
    std::uint64_t filled = 0;
    for (std::size_t i = 0; i < 64; ++i)
        filled |= static_cast<std::uint64_t>(numbers[i] != VoxelWorld::kNoBrick) << i;
    const std::array<Extents, 64> extents = grow_aadf_4(filled);
    BrickCells cells{};
    for (std::size_t i = 0; i < 64; ++i) {
        if (numbers[i] == VoxelWorld::kNoBrick) {
            cells[i] = gpu::make_cell(gpu::kCellEmpty, pack_distances(extents[i], gpu::kInnerDistanceBits));
            continue;
        }
        const VoxelWorld::Brick& brick = world.brick(numbers[i]);
        cells[i] = is_uniform(brick) ? gpu::make_cell(gpu::kCellSolid, brick[0] & gpu::kVoxelPayloadMask)
                                     : gpu::make_cell(gpu::kCellMixed, store.add(brick));
    }
    return cells;
}

bool is_one_solid(const BrickCells& cells) {
    return gpu::cell_state(cells[0]) == gpu::kCellSolid &&
           std::ranges::all_of(cells, [&](std::uint32_t cell) { return cell == cells[0]; });
}

}  // namespace

Naadf build_naadf(const VoxelWorld& world) {
    Naadf naadf{.origin = world.origin(), .chunks_size = world.chunks()};
    const glm::ivec3 size = world.chunks();
    BrickStore store(naadf.voxels);
    std::vector<std::uint8_t> filled;
    for (int z = 0; z < size.z; ++z) {
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const VoxelWorld::ChunkBricks* numbers = world.chunk({x, y, z});
                filled.push_back(numbers != nullptr ? 1 : 0);
                if (numbers == nullptr) {
                    naadf.chunks.push_back(0);
                    continue;
                }
                const BrickCells cells = pack_chunk(world, *numbers, store);
                if (is_one_solid(cells)) {
                    naadf.chunks.push_back(cells[0]);
                    continue;
                }
                const std::size_t child = naadf.bricks.size() / 64;
                naadf.chunks.push_back(
                    gpu::make_cell(gpu::kCellMixed, checked_cast<std::uint32_t>(child, "mixed chunks")));
                naadf.bricks.insert(naadf.bricks.end(), cells.begin(), cells.end());
            }
        }
    }
    const std::vector<Extents> extents = grow_aadf(size, filled, gpu::kChunkDistanceMax, Beyond::empty);
    for (std::size_t i = 0; i < filled.size(); ++i) {
        if (filled[i] == 0)
            naadf.chunks[i] =
                gpu::make_cell(gpu::kCellEmpty, pack_distances(extents[i], gpu::kChunkDistanceBits));
    }
    return naadf;
}

}  // namespace voxilux
