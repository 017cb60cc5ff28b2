#include "scene/voxel_grid.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "base/assert.h"
#include "base/checked_cast.h"
#include "scene/scene_bounds.h"

namespace voxilux {
namespace {

constexpr int kKeyBits = 21;
constexpr int kKeyBias = 1 << (kKeyBits - 1);

std::uint64_t key_of(glm::ivec3 block) {
    const auto part = [](int v) { return static_cast<std::uint64_t>(v + kKeyBias); };
    return (part(block.z) << (2 * kKeyBits)) | (part(block.y) << kKeyBits) | part(block.x);
}

glm::ivec3 block_of_key(std::uint64_t key) {
    const auto part = [&](int shift) {
        return static_cast<int>((key >> shift) & ((std::uint64_t{1} << kKeyBits) - 1)) - kKeyBias;
    };
    return {part(0), part(kKeyBits), part(2 * kKeyBits)};
}

// A voxel's coordinates inside a model are 16 bits.
constexpr int kModelSide = 1 << 16;

// Calls visit(position inside the block, material) for its voxels, x fastest.
template <class Block, class Visit>
void for_each_voxel(const Block& block, const Visit& visit) {
    std::size_t i = 0;
    for (const std::uint16_t material : block) {
        if (material <= kMaxGridMaterial) visit(glm::ivec3(i & 7, (i >> 3) & 7, i >> 6), material);
        ++i;
    }
}

}  // namespace

const VoxelGrid::Block* VoxelGrid::find(glm::ivec3 block) const {
    const auto found = blocks_.find(key_of(block));
    return found == blocks_.end() ? nullptr : found->second.get();
}

void VoxelGrid::fill_row(int x0, int x1, glm::ivec2 yz, std::optional<std::uint16_t> material) {
    if (x0 >= x1) return;
    const glm::ivec3 first(x0, yz), last(x1 - 1, yz);
    VX_ASSERT(glm::all(glm::greaterThanEqual(first, glm::ivec3(-kMaxGridCoordinate))));
    VX_ASSERT(glm::all(glm::lessThan(last, glm::ivec3(kMaxGridCoordinate))));
    VX_ASSERT(!material || *material <= kMaxGridMaterial);
    const glm::ivec2 block_yz = yz >> 3;
    const int row = ((yz.y & 7) * kSide + (yz.x & 7)) * kSide;
    for (int x = x0; x < x1; x = ((x >> 3) + 1) << 3) {
        const std::uint64_t key = key_of({x >> 3, block_yz});
        auto found = blocks_.find(key);
        if (found == blocks_.end()) {
            if (!material) continue;
            found = blocks_.emplace(key, std::make_unique<Block>()).first;
            found->second->fill(kEmpty);
            if (z_blocks_.x == z_blocks_.y) z_blocks_ = {block_yz.y, block_yz.y + 1};
            z_blocks_ = {std::min(z_blocks_.x, block_yz.y), std::max(z_blocks_.y, block_yz.y + 1)};
        }
        const auto begin = found->second->begin() + row;
        std::fill(begin + (x & 7), begin + std::min(kSide, (x & 7) + x1 - x), material.value_or(kEmpty));
    }
}

std::optional<std::uint16_t> VoxelGrid::at(glm::ivec3 cell) const {
    const Block* block = find(cell >> 3);
    if (block == nullptr) return std::nullopt;
    const std::uint16_t material =
        (*block)[static_cast<std::size_t>(((cell.z & 7) * kSide + (cell.y & 7)) * kSide + (cell.x & 7))];
    return material == kEmpty ? std::nullopt : std::optional(material);
}

std::optional<int> VoxelGrid::top_of_column(int x, int y) const {
    for (int block_z = z_blocks_.y - 1; block_z >= z_blocks_.x; --block_z) {
        if (find({x >> 3, y >> 3, block_z}) == nullptr) continue;
        for (int z = block_z * kSide + kSide - 1; z >= block_z * kSide; --z)
            if (at({x, y, z})) return z;
    }
    return std::nullopt;
}

std::vector<std::uint64_t> VoxelGrid::sorted_keys() const {
    std::vector<std::uint64_t> keys;
    keys.reserve(blocks_.size());
    for (const auto& [key, block] : blocks_)
        keys.push_back(key);
    std::ranges::sort(keys);
    return keys;
}

void VoxelGrid::append_to(Scene& scene, const std::string& name) const {
    const std::vector<std::uint64_t> keys = sorted_keys();
    glm::ivec3 first_block(std::numeric_limits<int>::max());
    for (const std::uint64_t key : keys)
        first_block = glm::min(first_block, block_of_key(key));
    std::map<std::tuple<int, int, int>, std::vector<std::uint64_t>> tiles;
    for (const std::uint64_t key : keys) {
        const glm::ivec3 tile = (block_of_key(key) - first_block) / (kModelSide / kSide);
        tiles[{tile.z, tile.y, tile.x}].push_back(key);
    }
    for (const auto& [tile, tile_keys] : tiles)
        append_model(scene, name, tile_keys);
}

void VoxelGrid::append_model(Scene& scene, const std::string& name,
                             std::span<const std::uint64_t> keys) const {
    Box box;
    std::size_t voxel_count = 0;
    for (const std::uint64_t key : keys) {
        const glm::ivec3 corner = block_of_key(key) * kSide;
        glm::ivec3 lo(kSide), hi(0);
        for_each_voxel(*blocks_.at(key), [&](glm::ivec3 v, std::uint16_t) {
            lo = glm::min(lo, v);
            hi = glm::max(hi, v + 1);
            ++voxel_count;
        });
        box = united(box, {corner + lo, corner + hi});
    }
    if (voxel_count == 0) return;
    VoxelModel model{.name = name, .size = box.hi - box.lo};
    model.voxels.reserve(voxel_count);
    for (const std::uint64_t key : keys) {
        const glm::ivec3 corner = block_of_key(key) * kSide - box.lo;
        for_each_voxel(*blocks_.at(key), [&](glm::ivec3 v, std::uint16_t material) {
            v += corner;
            model.voxels.push_back({static_cast<std::uint16_t>(v.x), static_cast<std::uint16_t>(v.y),
                                    static_cast<std::uint16_t>(v.z), material});
        });
    }
    // With the pivot at size / 2, voxel v lands on box.lo + v.
    scene.instances.push_back({.model = checked_cast<std::uint32_t>(scene.models.size(), "model index"),
                               .translation = box.lo + model.size / 2});
    scene.models.push_back(std::move(model));
}

}  // namespace voxilux
