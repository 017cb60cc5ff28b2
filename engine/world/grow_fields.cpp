// The boxes of an unexpanded structure, on the CPU: the oracle of passes/world.h.

#include <algorithm>

#include "world/build_fields.h"
#include "world/world_view.h"

namespace voxilux {
namespace {

bool is_root(const MarchWorld& built, int log2) {
    return log2 == gpu::root_log2(static_cast<gpu::uint>(built.traversal));
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

void grow_level(MarchWorld& built, int log2) {
    std::vector<std::uint32_t>& words = level_words(built, log2);
    const std::vector<glm::ivec3> homes = level_homes(built, log2);
    std::vector<std::uint32_t> grown = words;
    for (gpu::uint number = 0; number < gpu::kGrowthSteps; ++number) {
        const gpu::GrowthStep step = gpu::growth_step(number);
        for (std::uint32_t i = 0; i < words.size(); ++i) {
            const glm::ivec3 cell = log2 == gpu::kChunkLog2 ? gpu::grid_cell(i, built.chunks_size)
                                                            : gpu::child_cell(homes[i / 64], i % 64);
            grown[i] = gpu::grown_word(built, words[i], cell, log2, built.chunks_size, step);
        }
        words.swap(grown);
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
