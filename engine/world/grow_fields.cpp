// The boxes of an unexpanded structure, on the CPU: the bits of passes/world.h.

#include <algorithm>
#include <array>
#include <span>

#include "base/parallel_blocks.h"
#include "world/build_fields.h"
#include "world/world_view.h"

namespace voxilux {
namespace {

constexpr std::size_t kCellsAtOnce = std::size_t{1} << 15, kChunksAtOnce = kCellsAtOnce / 64;

bool is_root(const MarchWorld& built, int log2) {
    return log2 == gpu::root_log2(static_cast<gpu::uint>(built.traversal));
}

void grow_chunks(const MarchWorld& built, const gpu::GrowthStep& step, std::vector<std::uint32_t>& grown) {
    for_each_part(grown.size(), kCellsAtOnce, [&](std::size_t first, std::size_t end) {
        for (auto i = static_cast<std::uint32_t>(first); i < end; ++i)
            grown[i] = gpu::grown_word(built, built.roots[i], gpu::grid_cell(i, built.chunks_size),
                                       gpu::kChunkLog2, built.chunks_size, step);
    });
}

// The chunks in a line along an axis, as the bricks of the middle one see them. What a step looks at is found
// with one look at each chunk, where gpu::distances_at takes one for each brick.
class ChunkLine {
  public:
    ChunkLine(const MarchWorld& built, glm::ivec3 chunk, const gpu::GrowthStep& step)
        : step_(step), axis_(static_cast<int>(step.axis)), stride_(1 << (2 * axis_)) {
        const int reach = (step.bound + 3) / 4;
        for (int i = -reach; i <= reach; ++i) {
            glm::ivec3 other = chunk;
            other[axis_] += i;
            chunks_[static_cast<std::size_t>(i + kReach)] = look_at(built, other);
        }
    }

    // What gpu::grown_word is for brick `slot` of the middle chunk.
    [[nodiscard]] std::uint32_t grown(std::uint32_t own, int slot) const {
        if (gpu::cell_state(own) != gpu::kCellEmpty) return own;
        const int place = slot / stride_ & 3;
        const int beside = slot - place * stride_;
        const auto low = static_cast<int>(gpu::distance_towards(own, 2 * step_.axis));
        const auto high = static_cast<int>(gpu::distance_towards(own, 2 * step_.axis + 1));
        std::uint32_t grown = own;
        if (low < step_.bound)
            grown = gpu::joined_distances(grown, distances_at(place - low - 1, beside), 2 * step_.axis,
                                          step_.bound);
        if (high < step_.bound)
            grown = gpu::joined_distances(grown, distances_at(place + high + 1, beside), 2 * step_.axis + 1,
                                          step_.bound);
        return grown;
    }

  private:
    static constexpr int kReach = 8;  // chunks: 31 bricks
    struct Chunk {
        const std::uint32_t* bricks = nullptr;  // null where all are alike
        std::uint32_t distances = 0;            // of an empty chunk, else those of all bricks
        bool is_empty = false;
    };

    static Chunk look_at(const MarchWorld& built, glm::ivec3 chunk) {
        if (gpu::is_outside(chunk, built.chunks_size)) return {.distances = gpu::kEndless};
        const std::uint32_t number = gpu::grid_index(chunk, built.chunks_size);
        if (is_root(built, gpu::kBrickLog2)) return {.bricks = &built.roots[std::size_t{number} * 64]};
        const std::uint32_t root = built.roots[number];
        const std::uint32_t payload = gpu::cell_payload(root);
        if (gpu::cell_state(root) == gpu::kCellMixed)
            return {.bricks = &built.nodes[std::size_t{payload} * 64]};
        if (gpu::cell_state(root) == gpu::kCellEmpty) return {.distances = payload, .is_empty = true};
        return {.distances = gpu::kNotEmpty};
    }

    // `along` counts from the first brick of the middle chunk; `beside` is the slot of the brick but for the
    // axis.
    [[nodiscard]] std::uint32_t distances_at(int along, int beside) const {
        const Chunk& chunk = chunks_[static_cast<std::size_t>((along >> 2) + kReach)];
        const auto slot = static_cast<std::uint32_t>(beside + (along & 3) * stride_);
        if (chunk.bricks != nullptr) {
            const std::uint32_t brick = chunk.bricks[slot];
            return gpu::cell_state(brick) == gpu::kCellEmpty ? brick : gpu::kNotEmpty;
        }
        return chunk.is_empty ? gpu::inherited_distances(chunk.distances, gpu::slot_cell(slot))
                              : chunk.distances;
    }

    gpu::GrowthStep step_;
    int axis_;
    int stride_;  // of the axis in slots
    std::array<Chunk, 2 * kReach + 1> chunks_;
};

void grow_bricks(const MarchWorld& built, std::span<const glm::ivec3> homes, const gpu::GrowthStep& step,
                 std::vector<std::uint32_t>& grown) {
    const std::vector<std::uint32_t>& words = level_words(built, gpu::kBrickLog2);
    for_each_part(homes.size(), kChunksAtOnce, [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) {
            const ChunkLine line(built, homes[i], step);
            for (std::size_t slot = 0; slot < 64; ++slot)
                grown[64 * i + slot] = line.grown(words[64 * i + slot], static_cast<int>(slot));
        }
    });
}

}  // namespace

std::vector<int> growing_levels(Traversal traversal) {
    switch (traversal) {
        case Traversal::naadf:
            return {gpu::kChunkLog2};
        case Traversal::deep:
            return {gpu::kChunkLog2, gpu::kBrickLog2};
        case Traversal::wide:
            return {gpu::kBrickLog2};
        default:
            return {};
    }
}

std::vector<std::uint32_t>& level_words(MarchWorld& built, int log2) {
    return is_root(built, log2) ? built.roots : built.nodes;
}

const std::vector<std::uint32_t>& level_words(const MarchWorld& built, int log2) {
    return is_root(built, log2) ? built.roots : built.nodes;
}

std::vector<glm::ivec3> level_homes(const MarchWorld& built, int log2) {
    if (log2 == gpu::kChunkLog2) return {};
    if (!is_root(built, log2)) return built.node_homes;
    std::vector<glm::ivec3> homes(built.roots.size() / 64);
    for (std::uint32_t i = 0; i < homes.size(); ++i)
        homes[i] = gpu::grid_cell(i, built.chunks_size);
    return homes;
}

void BoxGrowth::begin_level() {
    homes_ = level_homes(*built_, levels_[level_]);
    grown_ = level_words(*built_, levels_[level_]);
}

bool BoxGrowth::step() {
    if (level_ == levels_.size()) return false;
    if (number_ == 0) begin_level();
    const gpu::GrowthStep step = gpu::growth_step(number_);
    if (levels_[level_] == gpu::kChunkLog2)
        grow_chunks(*built_, step, grown_);
    else
        grow_bricks(*built_, homes_, step, grown_);
    level_words(*built_, levels_[level_]).swap(grown_);
    if (++number_ < gpu::kGrowthSteps) return true;
    number_ = 0;
    return ++level_ < levels_.size();
}

void grow_boxes(MarchWorld& built) {
    BoxGrowth growth(built);
    while (growth.step()) {
    }
}

GrowthNeeds growth_needs(const MarchWorld& unexpanded) {
    GrowthNeeds needs;
    for (const int log2 : growing_levels(unexpanded.traversal)) {
        const std::uint64_t cells = level_words(unexpanded, log2).size();
        if (cells == 0) continue;
        const std::uint64_t homes = log2 == gpu::kChunkLog2 ? 1 : cells / 64;
        needs.home_bytes = std::max(needs.home_bytes, homes * sizeof(glm::ivec3));
        needs.grown_bytes = std::max(needs.grown_bytes, cells * sizeof(std::uint32_t));
        needs.levels.push_back({.log2 = log2, .cells = cells});
    }
    return needs;
}

}  // namespace voxilux
