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

// Appends mixed bricks to the leaves. Those whose boxes stay inside are stored once per distinct content.
class LeafStore {
  public:
    LeafStore(MarchWorld& built)
        : built_(built), is_far_(gpu::has_far_voxels(static_cast<gpu::uint>(built.traversal))) {}

    // `home` is the brick's place: chunk number * 64 + slot.
    std::uint32_t add(const VoxelWorld::Brick& brick, std::uint32_t home) {
        if (is_far_) return append_far(brick, home);
        const std::string key(reinterpret_cast<const char*>(brick.data()), sizeof(brick));
        const auto number = checked_cast<std::uint32_t>(built_.leaves.size() / 32, "distinct bricks");
        const auto [known, is_new] = numbers_.try_emplace(key, number);
        if (is_new) append_near(brick);
        return known->second;
    }

  private:
    std::uint32_t append_far(const VoxelWorld::Brick& brick, std::uint32_t home) {
        const auto number = checked_cast<std::uint32_t>(built_.leaves.size() / 64, "mixed bricks");
        for (const std::uint16_t voxel : brick)
            built_.leaves.push_back(gpu::cell_of_voxel(voxel));
        built_.leaf_homes.push_back(home);
        return number;
    }

    void append_near(const VoxelWorld::Brick& brick) {
        const std::array<Extents, 64> extents = grow_aadf_4(filled_mask(brick));
        for (std::size_t i = 0; i < 64; i += 2) {
            const auto half = [&](std::size_t k) {
                return brick[k] != VoxelWorld::kEmpty ? std::uint32_t{brick[k]} : pack_near(extents[k]);
            };
            built_.leaves.push_back(half(i) | (half(i + 1) << 16));
        }
    }

    MarchWorld& built_;
    bool is_far_;
    std::unordered_map<std::string, std::uint32_t> numbers_;
};

using BrickCells = std::array<std::uint32_t, 64>;

BrickCells pack_chunk(const VoxelWorld& world, const VoxelWorld::ChunkBricks& numbers, std::uint32_t chunk,
                      LeafStore& store) {
    BrickCells cells{};
    for (std::uint32_t i = 0; i < 64; ++i) {
        if (numbers[i] == VoxelWorld::kNoBrick) {
            cells[i] = gpu::make_cell(gpu::kCellEmpty, 0);
            continue;
        }
        const VoxelWorld::Brick& brick = world.brick(numbers[i]);
        if (!is_uniform(brick)) {
            cells[i] = gpu::make_cell(gpu::kCellMixed, store.add(brick, chunk * 64 + i));
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
std::uint32_t store_chunk(MarchWorld& built, BrickCells& cells, std::uint32_t chunk) {
    if (is_one_cell(cells)) return cells[0];
    if (built.traversal == Traversal::naadf) add_near_distances(cells);
    const auto number = checked_cast<std::uint32_t>(built.nodes.size() / 64, "mixed chunks");
    built.nodes.insert(built.nodes.end(), cells.begin(), cells.end());
    built.node_homes.push_back(chunk);
    return gpu::make_cell(gpu::kCellMixed, number);
}

}  // namespace

std::vector<std::uint32_t>& level_cells(MarchWorld& built, int log2) {
    if (log2 == gpu::root_log2(static_cast<gpu::uint>(built.traversal))) return built.roots;
    return log2 == gpu::kBrickLog2 ? built.nodes : built.leaves;
}

const std::vector<std::uint32_t>& level_cells(const MarchWorld& built, int log2) {
    return level_cells(const_cast<MarchWorld&>(built), log2);
}

const std::vector<std::uint32_t>& level_homes(const MarchWorld& built, int log2) {
    static const std::vector<std::uint32_t> none;
    if (log2 == gpu::root_log2(static_cast<gpu::uint>(built.traversal))) return none;
    return log2 == gpu::kBrickLog2 ? built.node_homes : built.leaf_homes;
}

GrowthNeeds growth_needs(const MarchWorld& skeleton) {
    GrowthNeeds needs;
    for (const int log2 : far_levels(skeleton.traversal)) {
        const std::uint64_t cells = level_cells(skeleton, log2).size();
        if (cells == 0) continue;
        needs.grown_bytes = std::max(needs.grown_bytes, cells * 4);
        needs.home_bytes =
            std::max<std::uint64_t>({needs.home_bytes, level_homes(skeleton, log2).size() * 4, 4});
        needs.steps += gpu::kAadfSteps;
    }
    return needs;
}

std::vector<int> far_levels(Traversal traversal) {
    const auto id = static_cast<gpu::uint>(traversal);
    if (traversal == Traversal::dda || traversal == Traversal::brick4 || traversal == Traversal::brick8)
        return {};
    std::vector<int> levels = {gpu::root_log2(id)};
    if (gpu::has_brick_nodes(id) && traversal != Traversal::naadf) levels.push_back(gpu::kBrickLog2);
    if (gpu::has_far_voxels(id)) levels.push_back(0);
    return levels;
}

void grow_level(MarchWorld& built, int log2) {
    const bool is_root = log2 == gpu::root_log2(static_cast<gpu::uint>(built.traversal));
    const glm::ivec3 grid = built.size() >> log2;
    const std::vector<std::uint32_t>& homes = level_homes(built, log2);
    std::vector<std::uint32_t>& cells = level_cells(built, log2);
    std::vector<std::uint32_t> grown = cells;
    for (gpu::uint step = 0; step < gpu::kAadfSteps; ++step) {
        for (std::uint32_t i = 0; i < cells.size(); ++i) {
            if (gpu::cell_state(cells[i]) != gpu::kCellEmpty) continue;
            const glm::ivec3 cell = is_root ? gpu::grid_cell(i, grid)
                                            : gpu::home_cell(homes[i / 64], i % 64, log2, built.chunks_size);
            grown[i] = gpu::grown_cell(built, cells[i], cell, log2, built.chunks_size, step % 3,
                                       gpu::aadf_bound(step / 3));
        }
        cells.swap(grown);
    }
}

void build_skeleton(const VoxelWorld& world, MarchWorld& built) {
    const int log2 = gpu::root_log2(static_cast<gpu::uint>(built.traversal));
    const glm::ivec3 grid = built.size() >> log2;
    built.roots.assign(static_cast<std::size_t>(grid.x) * static_cast<std::size_t>(grid.y) *
                           static_cast<std::size_t>(grid.z),
                       gpu::make_cell(gpu::kCellEmpty, 0));
    LeafStore store(built);
    world.for_each_chunk([&](glm::ivec3 chunk_cell, const VoxelWorld::ChunkBricks& numbers) {
        const std::uint32_t chunk = gpu::grid_index(chunk_cell, world.chunks());
        BrickCells cells = pack_chunk(world, numbers, chunk, store);
        if (gpu::has_brick_nodes(static_cast<gpu::uint>(built.traversal))) {
            built.roots[chunk] = store_chunk(built, cells, chunk);
            return;
        }
        for (std::uint32_t i = 0; i < 64; ++i)
            built.roots[gpu::grid_index(chunk_cell * 4 + gpu::slot_cell(i), grid)] = cells[i];
    });
}

}  // namespace voxilux
