#include "world/edit_world.h"

#include <algorithm>
#include <functional>
#include <span>
#include <utility>

#include "base/checked_cast.h"
#include "world/build_fields.h"
#include "world/cut_box.h"
#include "world/leaf_block.h"
#include "world/world_view.h"

namespace voxilux {
namespace {

// Cells that a box reaches.
constexpr int kLongest = static_cast<int>(gpu::kDistanceOnes);
// In place of a block's number, until the block is stored.
constexpr std::uint32_t kNoBlock = gpu::kCellPayloadMask;

template <class Visit>
void for_each_cell(CellBounds bounds, glm::ivec3 size, const Visit& visit) {
    const auto [low, high] = bounds.inside(size);
    for (int z = low.z; z < high.z; ++z)
        for (int y = low.y; y < high.y; ++y)
            for (int x = low.x; x < high.x; ++x)
                visit(glm::ivec3(x, y, z));
}

bool is_empty(std::uint32_t cell) {
    return gpu::cell_state(cell) == gpu::kCellEmpty;
}

// One edit of a structure with free boxes: first the states of cells, then the boxes that reach into what has
// been filled.
class Edit {
  public:
    Edit(const VoxelWorld& world, MarchWorld& built)
        : world_(world),
          built_(built),
          has_nodes_(built.traversal == Traversal::deep),
          first_new_node_(built.nodes.size()),
          first_new_leaf_(built.leaves.size()) {}

    void touch(glm::ivec3 brick) {
        const std::uint32_t before = brick_state(brick);
        const std::uint32_t after = pack(brick);
        if (is_empty(before) && is_empty(after)) return;  // its box stays
        if (has_nodes_) open_chunk(brick >> 2);
        assign(brick_word(brick), after);
        has_stale_boxes_ |= is_empty(before) != is_empty(after);
        if (is_empty(before)) filled_bricks_.include(brick);
        if (is_empty(after)) cleared_bricks_.push_back(brick);
        if (has_nodes_) close_chunk(brick >> 2);
    }

    void change_boxes() {
        if (has_nodes_) cut_chunks();
        cut_bricks();
        grow_boxes_of(gpu::kChunkLog2, cleared_chunks_);
        grow_boxes_of(gpu::kBrickLog2, cleared_bricks_);
    }

    // Gives a mixed brick the block that follows from its voxels and those of the bricks around it.
    void store_leaf(glm::ivec3 brick) {
        if (!world_.contains(brick * 4)) return;
        std::uint32_t* word = brick_word(brick);
        if (word == nullptr || gpu::cell_state(*word) != gpu::kCellMixed) return;
        const LeafBlock block =
            leaf_block(world_.brick(world_.brick_number(brick)), near_boxes(surroundings_of(world_, brick)));
        const std::size_t number = gpu::cell_payload(*word);
        if (number != kNoBlock &&
            std::equal(block.begin(), block.end(), built_.leaves.data() + number * block.size()))
            return;
        assign(word,
               gpu::make_cell(gpu::kCellMixed, checked_cast<std::uint32_t>(
                                                   built_.leaves.size() / block.size(), "mixed bricks")));
        built_.leaves.insert(built_.leaves.end(), block.begin(), block.end());
    }

    [[nodiscard]] WorldChanges changes() {
        if (first_new_node_ < built_.nodes.size())
            changed_nodes_.push_back({first_new_node_, built_.nodes.size()});
        WorldChanges changes{.has_stale_boxes = has_stale_boxes_,
                             .roots = joined_ranges(std::move(changed_roots_)),
                             .nodes = joined_ranges(std::move(changed_nodes_)),
                             .leaves = {}};
        if (first_new_leaf_ < built_.leaves.size())
            changes.leaves.push_back({first_new_leaf_, built_.leaves.size()});
        return changes;
    }

  private:
    void assign(std::uint32_t* word, std::uint32_t value) {
        *word = value;
        note(word, 1);
    }

    // Remembers that roots or nodes have changed.
    void note(const std::uint32_t* words, std::size_t count) {
        const std::uint32_t* roots = built_.roots.data();
        const bool are_roots =
            !std::less<>()(words, roots) && std::less<>()(words, roots + built_.roots.size());
        const auto first = static_cast<std::size_t>(words - (are_roots ? roots : built_.nodes.data()));
        (are_roots ? changed_roots_ : changed_nodes_).push_back({first, first + count});
    }

    // The word of a brick; null inside a chunk that has no nodes.
    std::uint32_t* brick_word(glm::ivec3 brick) {
        if (!has_nodes_)
            return &built_.roots[gpu::root_index(brick * 4, built_.chunks_size, gpu::kBrickLog2)];
        const std::uint32_t root = chunk_word(brick >> 2);
        if (gpu::cell_state(root) != gpu::kCellMixed) return nullptr;
        return &built_.nodes[gpu::cell_payload(root) * 64 + gpu::child_slot(brick & 3)];
    }

    std::uint32_t& chunk_word(glm::ivec3 chunk) {
        return built_.roots[gpu::grid_index(chunk, built_.chunks_size)];
    }

    std::uint32_t brick_state(glm::ivec3 brick) {
        const std::uint32_t* word = brick_word(brick);
        return word != nullptr ? *word : chunk_word(brick >> 2);
    }

    // The cell of a brick as its voxels are now. A mixed one has no block yet.
    std::uint32_t pack(glm::ivec3 brick) const {
        const std::uint16_t first = world_.get(brick * 4);
        for (std::uint32_t i = 1; i < 64; ++i) {
            if (world_.get(brick * 4 + gpu::slot_cell(i)) != first)
                return gpu::make_cell(gpu::kCellMixed, kNoBlock);
        }
        return gpu::cell_of_voxel(first);
    }

    // Splits a chunk of one cell into 64 bricks.
    void open_chunk(glm::ivec3 chunk) {
        std::uint32_t& root = chunk_word(chunk);
        const std::uint32_t before = root;
        if (gpu::cell_state(before) == gpu::kCellMixed) return;
        if (is_empty(before)) filled_chunks_.include(chunk);
        assign(&root, gpu::make_cell(gpu::kCellMixed,
                                     checked_cast<std::uint32_t>(built_.nodes.size() / 64, "mixed chunks")));
        for (std::uint32_t slot = 0; slot < 64; ++slot)
            built_.nodes.push_back(is_empty(before) ? gpu::inherited_distances(before, gpu::slot_cell(slot))
                                                    : before);
        built_.node_homes.push_back(chunk);
    }

    // Joins the bricks of a chunk into one cell when all have become equal.
    void close_chunk(glm::ivec3 chunk) {
        std::uint32_t& root = chunk_word(chunk);
        const auto cells = std::span(built_.nodes).subspan(std::size_t{gpu::cell_payload(root)} * 64, 64);
        const bool all_empty = std::ranges::all_of(cells, is_empty);
        const bool all_solid =
            gpu::cell_state(cells[0]) == gpu::kCellSolid &&
            std::ranges::all_of(cells, [&](std::uint32_t cell) { return cell == cells[0]; });
        if (all_empty || all_solid) assign(&root, all_empty ? 0 : cells[0]);
        if (all_empty) cleared_chunks_.push_back(chunk);
    }

    // Gives cells that were cleared boxes from those around them.
    void grow_boxes_of(int log2, const std::vector<glm::ivec3>& cleared) {
        for (gpu::uint number = 0; number < gpu::kGrowthSteps; ++number) {
            for (const glm::ivec3 cell : cleared) {
                std::uint32_t* const word = log2 == gpu::kChunkLog2 ? &chunk_word(cell) : brick_word(cell);
                if (word != nullptr)
                    assign(word, gpu::grown_word(built_, *word, cell, log2, built_.chunks_size,
                                                 gpu::growth_step(number)));
            }
        }
    }

    void cut_chunks() {
        for_each_cell(filled_chunks_.grown(glm::ivec3(kLongest)), built_.chunks_size, [&](glm::ivec3 chunk) {
            std::uint32_t& root = chunk_word(chunk);
            cut_run(std::span(&root, 1), filled_chunks_, [&](std::size_t) { return chunk; });
        });
    }

    void cut_bricks() {
        const CellBounds near = filled_bricks_.grown(glm::ivec3(kLongest)).parents();
        for_each_cell(near, built_.chunks_size, [&](glm::ivec3 chunk) {
            std::size_t block = gpu::grid_index(chunk, built_.chunks_size);
            if (has_nodes_) {
                const std::uint32_t root = built_.roots[block];
                if (gpu::cell_state(root) != gpu::kCellMixed) return;
                block = gpu::cell_payload(root);
            }
            const auto bricks = std::span(has_nodes_ ? built_.nodes : built_.roots).subspan(64 * block, 64);
            cut_run(bricks, filled_bricks_,
                    [&](std::size_t slot) { return gpu::child_cell(chunk, static_cast<gpu::uint>(slot)); });
        });
    }

    // Cuts the boxes of cells whose words follow each other.
    template <class CellOf>
    void cut_run(std::span<std::uint32_t> words, const CellBounds& filled, const CellOf& cell_of) {
        std::size_t first = words.size();
        std::size_t end = 0;
        for (std::size_t i = 0; i < words.size(); ++i) {
            if (!is_empty(words[i])) continue;
            const std::uint32_t cut = cut_distances(words[i], cell_of(i), filled);
            if (std::exchange(words[i], cut) == cut) continue;
            first = std::min(first, i);
            end = i + 1;
        }
        if (first < end) note(&words[first], end - first);
    }

    const VoxelWorld& world_;
    MarchWorld& built_;
    bool has_nodes_;
    bool has_stale_boxes_ = false;
    std::size_t first_new_node_;
    std::size_t first_new_leaf_;
    std::vector<WordRange> changed_roots_;
    std::vector<WordRange> changed_nodes_;
    CellBounds filled_chunks_;  // around those that were empty
    CellBounds filled_bricks_;
    std::vector<glm::ivec3> cleared_chunks_;
    std::vector<glm::ivec3> cleared_bricks_;
};

void sort_unique(std::vector<glm::ivec3>& bricks) {
    std::ranges::sort(bricks, [](glm::ivec3 a, glm::ivec3 b) {
        return a.z != b.z ? a.z < b.z : a.y != b.y ? a.y < b.y : a.x < b.x;
    });
    bricks.erase(std::unique(bricks.begin(), bricks.end()), bricks.end());
}

// The bricks and those around them that are not empty, each once.
std::vector<glm::ivec3> with_neighbours(const std::vector<glm::ivec3>& bricks, const VoxelWorld& world) {
    std::vector<glm::ivec3> all;
    for (const glm::ivec3 brick : bricks) {
        for (int i = 0; i < 27; ++i) {
            const glm::ivec3 near = brick + glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1;
            if (world.brick_number(near) != VoxelWorld::kNoBrick) all.push_back(near);
        }
    }
    sort_unique(all);
    return all;
}

}  // namespace

WorldChanges edit_world(VoxelWorld& world, MarchWorld& built, std::span<const VoxelEdit> edits) {
    std::vector<glm::ivec3> bricks;
    for (const VoxelEdit& edit : edits) {
        world.put(edit.local, edit.voxel);
        const glm::ivec3 brick = edit.local >> gpu::kBrickLog2;
        if (bricks.empty() || bricks.back() != brick) bricks.push_back(brick);
    }
    if (!has_free_boxes(built.traversal)) {
        built = build_march_world(world, built.traversal);
        return {.is_rebuilt = true};
    }
    sort_unique(bricks);
    Edit edit(world, built);
    for (const glm::ivec3 brick : bricks)
        edit.touch(brick);
    edit.change_boxes();
    for (const glm::ivec3 brick : with_neighbours(bricks, world))
        edit.store_leaf(brick);
    return edit.changes();
}

Regrowth::Regrowth(const MarchWorld& built)
    : grown_{.traversal = built.traversal,
             .origin = built.origin,
             .chunks_size = built.chunks_size,
             .roots = built.roots,
             .nodes = built.nodes,
             .leaves = {},
             .node_homes = built.node_homes} {
    for (const int log2 : growing_levels(built.traversal))
        for (std::uint32_t& word : level_words(grown_, log2))
            if (is_empty(word)) word = 0;
    growth_.emplace(grown_);
}

WorldChanges Regrowth::finish(MarchWorld& built) {
    while (growth_->step()) {
    }
    WorldChanges changes{.roots = differing_words(built.roots, grown_.roots),
                         .nodes = differing_words(built.nodes, grown_.nodes),
                         .leaves = {}};
    built.roots = std::move(grown_.roots);
    built.nodes = std::move(grown_.nodes);
    return changes;
}

}  // namespace voxilux
