#include "world/build_fields.h"

#include <algorithm>
#include <string>
#include <unordered_map>

#include "base/checked_cast.h"
#include "world/aadf.h"
#include "world/world_view.h"

namespace voxilux {
namespace {

std::uint32_t pack_near(const Extents& extents) {
    std::uint32_t packed = 0;
    for (std::uint32_t direction = 0; direction < 6; ++direction)
        packed |= std::uint32_t{extents[direction]} << (direction * gpu::kNearBits);
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

// Appends mixed bricks to the leaves. Boxes that stay inside the brick are made here, and such bricks are
// stored once per distinct content.
class LeafStore {
  public:
    explicit LeafStore(MarchWorld& built)
        : built_(built), is_free_(gpu::has_free_boxes(static_cast<gpu::uint>(built.traversal))) {}

    // `cell` counts bricks.
    std::uint32_t add(const VoxelWorld::Brick& brick, glm::ivec3 cell) {
        const auto number = checked_cast<std::uint32_t>(built_.leaves.size() / 32, "mixed bricks");
        if (is_free_) {
            built_.leaf_homes.push_back(gpu::pack_home(cell));
            append(brick, {});
            return number;
        }
        const std::string key(reinterpret_cast<const char*>(brick.data()), sizeof(brick));
        const auto [known, is_new] = numbers_.try_emplace(key, number);
        if (is_new) append(brick, grow_aadf_4(filled_mask(brick)));
        return known->second;
    }

  private:
    void append(const VoxelWorld::Brick& brick, const std::array<Extents, 64>& extents) {
        const auto half = [&](std::size_t i) {
            return brick[i] != VoxelWorld::kEmpty ? std::uint32_t{brick[i]} : pack_near(extents[i]);
        };
        for (std::size_t i = 0; i < 64; i += 2)
            built_.leaves.push_back(half(i) | (half(i + 1) << 16));
    }

    MarchWorld& built_;
    bool is_free_;
    std::unordered_map<std::string, std::uint32_t> numbers_;
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
            cells[i] = gpu::make_cell(gpu::kCellMixed, store.add(brick, chunk_cell * 4 + gpu::slot_cell(i)));
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
    built.node_homes.push_back(gpu::pack_home(chunk_cell));
    return gpu::make_cell(gpu::kCellMixed, number);
}

}  // namespace

void build_skeleton(const VoxelWorld& world, MarchWorld& built) {
    const int log2 = gpu::root_log2(static_cast<gpu::uint>(built.traversal));
    const glm::ivec3 grid = built.size() >> log2;
    built.roots.assign(static_cast<std::size_t>(grid.x) * static_cast<std::size_t>(grid.y) *
                           static_cast<std::size_t>(grid.z),
                       gpu::make_cell(gpu::kCellEmpty, 0));
    LeafStore store(built);
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
