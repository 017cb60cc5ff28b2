#include "world/build_fields.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>

#include "base/checked_cast.h"
#include "world/aadf.h"
#include "world/leaf_block.h"
#include "world/world_view.h"

namespace voxilux {
namespace {

std::uint32_t pack_near(const Extents& extents) {
    std::uint32_t packed = 0;
    for (std::uint32_t direction = 0; direction < 6; ++direction)
        packed |= std::uint32_t{extents[direction]} << (direction * gpu::kNearBits);
    return packed;
}

bool is_uniform(const VoxelWorld::Brick& brick) {
    return std::ranges::all_of(brick, [&](std::uint16_t voxel) { return voxel == brick[0]; });
}

std::array<std::uint16_t, 64> confined_boxes(const VoxelWorld::Brick& brick) {
    const std::array<Extents, 64> extents = grow_aadf_4(filled_mask(brick));
    std::array<std::uint16_t, 64> boxes{};
    for (std::size_t i = 0; i < 64; ++i)
        boxes[i] = static_cast<std::uint16_t>(pack_near(extents[i]));
    return boxes;
}

// Appends mixed bricks to the leaves, each distinct block of words once.
class LeafStore {
  public:
    LeafStore(const VoxelWorld& world, MarchWorld& built)
        : world_(world),
          surroundings_(world),
          leaves_(built.leaves),
          is_free_(has_free_boxes(built.traversal)),
          confined_(is_free_ ? 0 : world.brick_count(), VoxelWorld::kNoBrick) {}

    // The brick at `cell`, which counts bricks.
    std::uint32_t add(std::uint32_t brick, glm::ivec3 cell) {
        if (is_free_) return store(leaf_block(world_.brick(brick), near_boxes(surroundings_.around(cell))));
        std::uint32_t& known = confined_[brick];
        if (known == VoxelWorld::kNoBrick)
            known = store(leaf_block(world_.brick(brick), confined_boxes(world_.brick(brick))));
        return known;
    }

  private:
    std::uint32_t store(const LeafBlock& block) {
        const auto number = checked_cast<std::uint32_t>(leaves_.size() / block.size(), "mixed bricks");
        const auto [known, is_new] = numbers_.try_emplace(block, number);
        if (is_new) leaves_.insert(leaves_.end(), block.begin(), block.end());
        return known->second;
    }

    struct Hash {
        std::size_t operator()(const LeafBlock& block) const {
            return std::hash<std::string_view>()(
                {reinterpret_cast<const char*>(block.data()), sizeof(block)});
        }
    };

    const VoxelWorld& world_;
    FilledMasks surroundings_;
    std::vector<std::uint32_t>& leaves_;
    bool is_free_;
    std::vector<std::uint32_t> confined_;  // by brick: its leaf, which depends on nothing around it
    std::unordered_map<LeafBlock, std::uint32_t, Hash> numbers_;
};

using BrickCells = std::array<std::uint32_t, 64>;

BrickCells pack_chunk(const VoxelWorld& world, const VoxelWorld::ChunkBricks& numbers, glm::ivec3 chunk_cell,
                      LeafStore& store) {
    BrickCells cells{};
    for (std::uint32_t i = 0; i < 64; ++i) {
        if (numbers[i] == VoxelWorld::kNoBrick) {
            cells[i] = gpu::make_cell(gpu::kCellEmpty, 0);
            continue;
        }
        const VoxelWorld::Brick& brick = world.brick(numbers[i]);
        if (!is_uniform(brick)) {
            cells[i] =
                gpu::make_cell(gpu::kCellMixed, store.add(numbers[i], chunk_cell * 4 + gpu::slot_cell(i)));
        } else {
            cells[i] = gpu::cell_of_voxel(brick[0]);
        }
    }
    return cells;
}

void add_near_distances(BrickCells& cells) {
    std::uint64_t filled = 0;
    for (std::size_t i = 0; i < 64; ++i)
        filled |= static_cast<std::uint64_t>(gpu::cell_state(cells[i]) != gpu::kCellEmpty) << i;
    const std::array<Extents, 64> extents = grow_aadf_4(filled);
    for (std::size_t i = 0; i < 64; ++i) {
        if (gpu::cell_state(cells[i]) == gpu::kCellEmpty)
            cells[i] = gpu::make_cell(gpu::kCellEmpty, pack_near(extents[i]));
    }
}

bool is_one_cell(const BrickCells& cells) {
    return gpu::cell_state(cells[0]) != gpu::kCellMixed &&
           std::ranges::all_of(cells, [&](std::uint32_t cell) { return cell == cells[0]; });
}

// The chunk as a root: one cell, or a block of nodes.
std::uint32_t store_chunk(MarchWorld& built, BrickCells& cells, glm::ivec3 chunk_cell) {
    if (is_one_cell(cells)) return cells[0];
    if (built.traversal == Traversal::naadf) add_near_distances(cells);
    const auto number = checked_cast<std::uint32_t>(built.nodes.size() / 64, "mixed chunks");
    built.nodes.insert(built.nodes.end(), cells.begin(), cells.end());
    built.node_homes.push_back(chunk_cell);
    return gpu::make_cell(gpu::kCellMixed, number);
}

}  // namespace

void build_unexpanded(const VoxelWorld& world, MarchWorld& built) {
    const int log2 = gpu::root_log2(static_cast<gpu::uint>(built.traversal));
    const glm::ivec3 grid = built.size() >> log2;
    built.roots.assign(static_cast<std::size_t>(grid.x) * static_cast<std::size_t>(grid.y) *
                           static_cast<std::size_t>(grid.z),
                       gpu::make_cell(gpu::kCellEmpty, 0));
    LeafStore store(world, built);
    world.for_each_chunk([&](glm::ivec3 chunk_cell, const VoxelWorld::ChunkBricks& numbers) {
        const std::uint32_t chunk = gpu::grid_index(chunk_cell, world.chunks());
        BrickCells cells = pack_chunk(world, numbers, chunk_cell, store);
        if (gpu::has_brick_nodes(static_cast<gpu::uint>(built.traversal))) {
            built.roots[chunk] = store_chunk(built, cells, chunk_cell);
            return;
        }
        for (std::uint32_t i = 0; i < 64; ++i)
            built.roots[chunk * 64 + i] = cells[i];
    });
}

}  // namespace voxilux
