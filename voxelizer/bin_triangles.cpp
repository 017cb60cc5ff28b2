#include "voxelizer/bin_triangles.h"

#include <algorithm>

#include "base/checked_cast.h"
#include "voxelizer/cover_triangle.h"

namespace voxilux {
namespace {

constexpr int kBlocksPerModel = kModelCells / kBlockCells;  // per axis
constexpr int kTriangleBits = 32;

// Blocks of a model have consecutive numbers: the number of the model in the high bits, the block's in the
// low ones. A grid of 65536^3 cells has 2^30 blocks.
class BlockNumbers {
  public:
    explicit BlockNumbers(glm::ivec3 cells) : models_(model_counts(cells)) {}

    [[nodiscard]] std::uint64_t number(glm::ivec3 block) const {
        const glm::ivec3 m = block / kBlocksPerModel;
        const glm::ivec3 b = block % kBlocksPerModel;
        const auto model = static_cast<std::uint64_t>((m.z * models_.y + m.y) * models_.x + m.x);
        const auto local = static_cast<std::uint64_t>((b.z * kBlocksPerModel + b.y) * kBlocksPerModel + b.x);
        return model * kPerModel + local;
    }

    [[nodiscard]] Block block(std::uint64_t number) const {
        const auto model = static_cast<int>(number / kPerModel);
        const auto local = static_cast<int>(number % kPerModel);
        const glm::ivec3 m{model % models_.x, model / models_.x % models_.y, model / models_.x / models_.y};
        const glm::ivec3 b{local % kBlocksPerModel, local / kBlocksPerModel % kBlocksPerModel,
                           local / kBlocksPerModel / kBlocksPerModel};
        return {.low = m * kModelCells + b * kBlockCells, .model = static_cast<std::uint32_t>(model)};
    }

  private:
    static constexpr std::uint64_t kPerModel = kBlocksPerModel * kBlocksPerModel * kBlocksPerModel;
    glm::ivec3 models_;
};

}  // namespace

glm::ivec3 model_counts(glm::ivec3 cells) {
    return (cells + kModelCells - 1) / kModelCells;
}

std::uint32_t model_of(glm::ivec3 cell, glm::ivec3 cells) {
    const glm::ivec3 m = cell / kModelCells;
    const glm::ivec3 counts = model_counts(cells);
    return static_cast<std::uint32_t>((m.z * counts.y + m.y) * counts.x + m.x);
}

Bins bin_triangles(const Mesh& mesh, std::span<const std::uint32_t> triangles,
                   std::span<const glm::ivec3> lattice, glm::ivec3 cells) {
    const BlockNumbers numbers(cells);
    std::vector<std::uint64_t> pairs;  // block in the high bits, triangle in the low ones
    for (const std::uint32_t index : triangles) {
        const glm::uvec3 v = mesh.triangles[index].vertices;
        const LatticeTriangle triangle = {lattice[v.x], lattice[v.y], lattice[v.z]};
        const TriangleCover cover = cover_of(triangle, kUnit * kBlockCells);
        for_each_span(cover, cover.box, [&](int y, int z, int first, int last) {
            for (int x = first; x <= last; ++x)
                pairs.push_back(numbers.number({x, y, z}) << kTriangleBits | index);
        });
    }
    std::ranges::sort(pairs);
    Bins bins;
    bins.triangles.reserve(pairs.size());
    for (const std::uint64_t pair : pairs) {
        const std::uint64_t number = pair >> kTriangleBits;
        if (bins.triangles.empty() || number != pairs[bins.triangles.size() - 1] >> kTriangleBits) {
            bins.blocks.push_back(numbers.block(number));
            bins.blocks.back().first = bins.triangles.size();
        }
        ++bins.blocks.back().count;
        bins.triangles.push_back(static_cast<std::uint32_t>(pair));
    }
    return bins;
}

}  // namespace voxilux
