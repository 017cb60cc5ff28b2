// The boxes of a skeleton, on the CPU: the oracle of passes/world.h.

#include <algorithm>
#include <bit>
#include <string_view>
#include <unordered_map>

#include "world/build_fields.h"
#include "world/world_view.h"

namespace voxilux {
namespace {

bool is_root(const MarchWorld& built, int log2) {
    return log2 == gpu::root_log2(static_cast<gpu::uint>(built.traversal));
}

std::uint64_t home_count(const MarchWorld& built, int log2) {
    return log2 == gpu::kChunkLog2 ? 0 : level_words(built, log2).size() / block_words(log2);
}

std::string_view block_bytes(const std::vector<std::uint32_t>& leaves, std::uint32_t number) {
    return {reinterpret_cast<const char*>(leaves.data() + std::size_t{number} * 32),
            32 * sizeof(std::uint32_t)};
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
    if (is_root(built, log2)) return built.roots;
    return log2 == gpu::kBrickLog2 ? built.nodes : built.leaves;
}

const std::vector<std::uint32_t>& level_words(const MarchWorld& built, int log2) {
    return level_words(const_cast<MarchWorld&>(built), log2);
}

std::uint32_t block_words(int log2) {
    return log2 == 0 ? 32 : 64;
}

std::uint32_t level_steps(int log2) {
    return gpu::growth_steps(gpu::level_bits(log2));
}

std::vector<glm::uvec2> level_homes(const MarchWorld& built, int log2) {
    if (log2 == gpu::kChunkLog2) return {};
    if (log2 == 0) return {};
    if (!is_root(built, log2)) return built.node_homes;
    std::vector<glm::uvec2> homes(built.roots.size() / 64);
    for (std::uint32_t i = 0; i < homes.size(); ++i)
        homes[i] = gpu::pack_home(gpu::grid_cell(i, built.chunks_size));
    return homes;
}

void grow_level(MarchWorld& built, int log2) {
    std::vector<std::uint32_t>& words = level_words(built, log2);
    const std::vector<glm::uvec2> homes = level_homes(built, log2);
    std::vector<std::uint32_t> grown = words;
    for (std::uint32_t number = 0; number < level_steps(log2); ++number) {
        const gpu::GrowthStep step = gpu::growth_step(number);
        for (std::uint32_t i = 0; i < words.size(); ++i) {
            if (log2 == 0) {
                grown[i] =
                    gpu::grown_leaf_word(built, words[i], homes[i / 32], i % 32, built.chunks_size, step);
                continue;
            }
            const glm::ivec3 cell = log2 == gpu::kChunkLog2 ? gpu::grid_cell(i, built.chunks_size)
                                                            : gpu::home_cell(homes[i / 64], i % 64);
            grown[i] = gpu::grown_word(built, words[i], cell, log2, built.chunks_size, step);
        }
        words.swap(grown);
    }
}

bool shares_leaves(Traversal traversal) {
    (void)traversal;
    return false;
}

void share_leaves(MarchWorld& built) {
    std::unordered_map<std::string_view, std::uint32_t> first;
    for (std::uint32_t number = 0; number < built.leaves.size() / 32; ++number)
        first.try_emplace(block_bytes(built.leaves, number), number);
    for (std::uint32_t& cell : level_words(built, gpu::kBrickLog2)) {
        if (gpu::cell_state(cell) != gpu::kCellMixed) continue;
        const std::uint32_t shared = first.at(block_bytes(built.leaves, gpu::cell_payload(cell)));
        cell = gpu::make_cell(gpu::kCellMixed, shared);
    }
}

GrowthNeeds growth_needs(const MarchWorld& skeleton) {
    GrowthNeeds needs;
    for (const int log2 : growing_levels(skeleton.traversal)) {
        const std::uint64_t words = level_words(skeleton, log2).size();
        if (words == 0) continue;
        needs.grown_bytes = std::max(needs.grown_bytes, words * 4);
        needs.home_bytes = std::max<std::uint64_t>({needs.home_bytes, home_count(skeleton, log2) * 8, 8});
        needs.steps += level_steps(log2);
    }
    const std::uint64_t bricks = skeleton.leaves.size() / 32;
    if (!shares_leaves(skeleton.traversal) || bricks == 0) return needs;
    needs.table_bytes = 4 * std::bit_ceil(2 * bricks);
    needs.place_bytes = 4 * bricks;
    return needs;
}

}  // namespace voxilux
