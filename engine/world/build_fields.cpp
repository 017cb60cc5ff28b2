#include "world/build_fields.h"

#include <algorithm>
#include <span>

#include "base/checked_cast.h"
#include "base/parallel_blocks.h"
#include "world/aadf.h"
#include "world/leaf_block.h"
#include "world/leaf_store.h"
#include "world/world_view.h"

namespace voxilux {
namespace {

constexpr std::size_t kRunChunks = 256;

std::uint32_t pack_near(const Extents& extents) {
    std::uint32_t packed = 0;
    for (std::uint32_t direction = 0; direction < 6; ++direction)
        packed |= std::uint32_t{extents[direction]} << (direction * gpu::kNearBits);
    return packed;
}

bool is_uniform(const VoxelWorld::Brick& brick) {
    return std::ranges::all_of(brick, [&](std::uint16_t voxel) { return voxel == brick[0]; });
}

std::array<std::uint16_t, 64> confined_boxes(const std::array<std::uint64_t, 1>& filled) {
    const std::array<Extents, 64> extents = grow_aadf_4(filled[0]);
    std::array<std::uint16_t, 64> boxes{};
    for (std::size_t i = 0; i < 64; ++i)
        boxes[i] = static_cast<std::uint16_t>(pack_near(extents[i]));
    return boxes;
}

// Boxes of bricks by what is filled, and the last ones of them: most bricks of a world look like others.
template <class Filled, class MakeBoxes>
class RecentBoxes {
  public:
    explicit RecentBoxes(const MakeBoxes& make) : make_(make) {}

    const std::array<std::uint16_t, 64>& of(const Filled& filled) {
        if (entries_.empty()) entries_.assign(kEntries, {.filled{}, .boxes = make_({})});
        Entry& entry = entries_[hash_of_bytes(filled) % kEntries];
        if (entry.filled != filled) entry = {filled, make_(filled)};
        return entry.boxes;
    }

  private:
    static constexpr std::size_t kEntries = 2048;  // what the cache of a core holds
    struct Entry {
        Filled filled;
        std::array<std::uint16_t, 64> boxes;
    };

    MakeBoxes make_;
    std::vector<Entry> entries_;  // by the hash of what is filled
};

using BrickCells = std::array<std::uint32_t, 64>;

// Chunks that follow each other in the order of the grid, packed on their own: what is mixed has the number
// of a block of these leaves.
struct PackedRun {
    std::vector<BrickCells> chunks;
    std::vector<std::uint32_t> leaves;
};

// Packs runs of chunks, one at a time.
class ChunkPacker {
  public:
    ChunkPacker(const VoxelWorld& world, const std::vector<std::uint64_t>& masks, bool is_free)
        : world_(world), masks_(masks), is_free_(is_free) {}

    PackedRun pack(std::span<const glm::ivec3> chunk_cells) {
        PackedRun run;
        run.chunks.reserve(chunk_cells.size());
        LeafStore store(run.leaves);
        for (const glm::ivec3 cell : chunk_cells)
            run.chunks.push_back(pack_chunk(cell, store));
        return run;
    }

  private:
    BrickCells pack_chunk(glm::ivec3 chunk_cell, LeafStore& store) {
        const VoxelWorld::ChunkBricks& numbers = *world_.chunk(chunk_cell);
        const ChunkSurroundings surroundings(world_, masks_, chunk_cell);
        BrickCells cells{};
        for (std::uint32_t i = 0; i < 64; ++i) {
            if (numbers[i] == VoxelWorld::kNoBrick) {
                cells[i] = gpu::make_cell(gpu::kCellEmpty, 0);
                continue;
            }
            const VoxelWorld::Brick& brick = world_.brick(numbers[i]);
            if (is_uniform(brick)) {
                cells[i] = gpu::cell_of_voxel(brick[0]);
                continue;
            }
            const auto& boxes = is_free_ ? free_.of(surroundings.around(gpu::slot_cell(i)))
                                         : confined_.of({masks_[numbers[i]]});
            cells[i] = gpu::make_cell(gpu::kCellMixed, store.add(leaf_block(brick, boxes)));
        }
        return cells;
    }

    const VoxelWorld& world_;
    const std::vector<std::uint64_t>& masks_;
    bool is_free_;
    RecentBoxes<BrickSurroundings, decltype(&near_boxes)> free_{&near_boxes};
    RecentBoxes<std::array<std::uint64_t, 1>, decltype(&confined_boxes)> confined_{&confined_boxes};
};

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

// Runs of chunks are packed one beside the other, and their blocks numbered in the order of the chunks: the
// same words for any number of threads.
std::vector<PackedRun> pack_runs(const VoxelWorld& world, std::span<const glm::ivec3> chunk_cells,
                                 bool is_free) {
    const std::vector<std::uint64_t> masks = filled_masks(world);
    std::vector<PackedRun> runs((chunk_cells.size() + kRunChunks - 1) / kRunChunks);
    for_each_block(runs.size(), thread_count(0), [&] {
        return [&, packer = ChunkPacker(world, masks, is_free)](std::size_t i) mutable {
            const std::size_t first = i * kRunChunks;
            runs[i] =
                packer.pack(chunk_cells.subspan(first, std::min(kRunChunks, chunk_cells.size() - first)));
        };
    });
    return runs;
}

void renumber(BrickCells& cells, const std::vector<std::uint32_t>& numbers) {
    for (std::uint32_t& cell : cells) {
        if (gpu::cell_state(cell) == gpu::kCellMixed)
            cell = gpu::make_cell(gpu::kCellMixed, numbers[gpu::cell_payload(cell)]);
    }
}

}  // namespace

void build_unexpanded(const VoxelWorld& world, MarchWorld& built) {
    const int log2 = gpu::root_log2(static_cast<gpu::uint>(built.traversal));
    const glm::ivec3 grid = built.size() >> log2;
    built.roots.assign(static_cast<std::size_t>(grid.x) * static_cast<std::size_t>(grid.y) *
                           static_cast<std::size_t>(grid.z),
                       gpu::make_cell(gpu::kCellEmpty, 0));
    std::vector<glm::ivec3> chunk_cells;
    world.for_each_chunk(
        [&](glm::ivec3 cell, const VoxelWorld::ChunkBricks&) { chunk_cells.push_back(cell); });
    LeafStore store(built.leaves);
    auto chunk_cell = chunk_cells.begin();
    for (PackedRun& run : pack_runs(world, chunk_cells, has_free_boxes(built.traversal))) {
        const std::vector<std::uint32_t> numbers = store.add_all(run.leaves);
        for (BrickCells& cells : run.chunks) {
            renumber(cells, numbers);
            const std::uint32_t chunk = gpu::grid_index(*chunk_cell, world.chunks());
            if (gpu::has_brick_nodes(static_cast<gpu::uint>(built.traversal)))
                built.roots[chunk] = store_chunk(built, cells, *chunk_cell);
            else
                std::ranges::copy(cells, built.roots.begin() + std::ptrdiff_t{chunk} * 64);
            ++chunk_cell;
        }
        run = {};
    }
}

}  // namespace voxilux
