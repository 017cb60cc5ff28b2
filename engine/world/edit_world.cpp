#include "world/edit_world.h"

#include <algorithm>
#include <functional>
#include <span>
#include <tuple>

#include "base/checked_cast.h"
#include "world/build_fields.h"
#include "world/growing_box.h"
#include "world/leaf_block.h"
#include "world/world_view.h"

namespace voxilux {
namespace {

// Most bricks whose boxes are redone for a batch of edits; each takes five bytes.
constexpr std::int64_t kMostRegrown = std::int64_t{1} << 26;

// Changed words with at most so many words between them share a range.
constexpr std::size_t kMaxGap = 16;
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

// Ranges that cover the words with these numbers, and all from `first_new` to `end`.
std::vector<WordRange> ranges_of(std::vector<std::size_t> words, std::size_t first_new, std::size_t end) {
    std::ranges::sort(words);
    std::vector<WordRange> ranges;
    for (const std::size_t word : words) {
        if (word >= first_new) break;
        if (ranges.empty() || ranges.back().end + kMaxGap < word)
            ranges.push_back({word, word + 1});
        else
            ranges.back().end = word + 1;
    }
    if (first_new < end) ranges.push_back({first_new, end});
    return ranges;
}

bool is_empty(std::uint32_t cell) {
    return gpu::cell_state(cell) == gpu::kCellEmpty;
}

// One edit of a structure with free boxes: first the states of cells, then the boxes from the largest cells
// down.
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
        if (is_empty(before) != is_empty(after)) bricks_.include(brick);
        if (has_nodes_) close_chunk(brick >> 2);
    }

    // False, with stale boxes, when edits lie so far apart that the bounds of all are too large.
    [[nodiscard]] bool grow() {
        if (has_nodes_)
            bricks_.include(
                regrow(gpu::kChunkLog2, chunks_.grown(glm::ivec3(GrowingBox::kReach))).children());
        const CellBounds bounds = bricks_.grown(glm::ivec3(GrowingBox::kReach));
        if (bounds.inside(built_.size() >> gpu::kBrickLog2).count() > kMostRegrown) return false;
        regrow(gpu::kBrickLog2, bounds);
        return true;
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

    [[nodiscard]] WorldChanges changes() const {
        return {.roots = ranges_of(changed_roots_, built_.roots.size(), built_.roots.size()),
                .nodes = ranges_of(changed_nodes_, first_new_node_, built_.nodes.size()),
                .leaves = ranges_of({}, first_new_leaf_, built_.leaves.size())};
    }

  private:
    void assign(std::uint32_t* word, std::uint32_t value) {
        *word = value;
        note(word);
    }

    // Remembers that a root or a node has changed.
    void note(const std::uint32_t* word) {
        const std::uint32_t* roots = built_.roots.data();
        const bool is_root = !std::less<>()(word, roots) && std::less<>()(word, roots + built_.roots.size());
        if (is_root)
            changed_roots_.push_back(static_cast<std::size_t>(word - roots));
        else
            changed_nodes_.push_back(static_cast<std::size_t>(word - built_.nodes.data()));
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
        if (gpu::cell_state(root) == gpu::kCellMixed) return;
        const std::uint32_t content = is_empty(root) ? 0 : root;
        if (is_empty(root)) chunks_.include(chunk);
        bricks_.include(CellBounds{chunk, chunk + 1}.children());
        assign(&root, gpu::make_cell(gpu::kCellMixed,
                                     checked_cast<std::uint32_t>(built_.nodes.size() / 64, "mixed chunks")));
        built_.nodes.insert(built_.nodes.end(), 64, content);
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
        if (!all_empty && !all_solid) return;
        if (all_empty) chunks_.include(chunk);
        bricks_.include(CellBounds{chunk, chunk + 1}.children());
        assign(&root, all_empty ? 0 : cells[0]);
    }

    std::uint32_t* level_word(int log2, glm::ivec3 cell) {
        return log2 == gpu::kChunkLog2 ? &chunk_word(cell) : brick_word(cell);
    }

    // Redoes the boxes of the roots or nodes in the bounds and returns the cells whose boxes have changed.
    CellBounds regrow(int log2, const CellBounds& bounds) {
        const glm::ivec3 level = built_.size() >> log2;
        GrowingBox box(bounds, level);
        for_each_cell(box.cells(), level, [&](glm::ivec3 cell) {
            const std::uint32_t* const word = level_word(log2, cell);
            if (word != nullptr && is_empty(*word))
                box.set_empty(cell);
            else
                box.set_fixed(cell, gpu::distances_at(built_, cell, log2, built_.chunks_size));
        });
        box.grow();
        CellBounds changed;
        for_each_cell(bounds, level, [&](glm::ivec3 cell) {
            std::uint32_t* const word = level_word(log2, cell);
            if (word == nullptr || !is_empty(*word) || *word == box.distances(cell)) return;
            assign(word, box.distances(cell));
            changed.include(cell);
        });
        return changed;
    }

    const VoxelWorld& world_;
    MarchWorld& built_;
    bool has_nodes_;
    std::size_t first_new_node_;
    std::size_t first_new_leaf_;
    std::vector<std::size_t> changed_roots_;
    std::vector<std::size_t> changed_nodes_;
    CellBounds chunks_;  // that became empty or stopped being so
    CellBounds bricks_;  // the same, and those whose chunk got or lost its nodes
};

void sort_unique(std::vector<glm::ivec3>& bricks) {
    std::ranges::sort(bricks, [](glm::ivec3 a, glm::ivec3 b) {
        return std::tuple(a.z, a.y, a.x) < std::tuple(b.z, b.y, b.x);
    });
    bricks.erase(std::unique(bricks.begin(), bricks.end()), bricks.end());
}

// The bricks and those around them, each once.
std::vector<glm::ivec3> with_neighbours(const std::vector<glm::ivec3>& bricks) {
    std::vector<glm::ivec3> all;
    all.reserve(27 * bricks.size());
    for (const glm::ivec3 brick : bricks)
        for (int i = 0; i < 27; ++i)
            all.push_back(brick + glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1);
    sort_unique(all);
    return all;
}

}  // namespace

WorldChanges edit_world(VoxelWorld& world, MarchWorld& built, std::span<const VoxelEdit> edits) {
    std::vector<glm::ivec3> bricks;
    for (const VoxelEdit& edit : edits) {
        world.put(edit.local, edit.voxel);
        bricks.push_back(edit.local >> gpu::kBrickLog2);
    }
    if (!has_free_boxes(built.traversal)) {
        built = build_march_world(world, built.traversal);
        return {.is_rebuilt = true};
    }
    sort_unique(bricks);
    Edit edit(world, built);
    for (const glm::ivec3 brick : bricks)
        edit.touch(brick);
    if (!edit.grow()) {
        built = build_march_world(world, built.traversal);
        return {.is_rebuilt = true};
    }
    for (const glm::ivec3 brick : with_neighbours(bricks))
        edit.store_leaf(brick);
    return edit.changes();
}

}  // namespace voxilux
