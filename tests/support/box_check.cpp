#include "support/box_check.h"

#include <fmt/format.h>

#include "world/build_fields.h"
#include "world/world_view.h"

namespace voxilux::test {

FilledCount::FilledCount(const VoxelWorld& world) : size_(world.size()) {
    below_.resize(index(size_) + 1);
    for (int z = 1; z <= size_.z; ++z) {
        for (int y = 1; y <= size_.y; ++y) {
            int row = 0;
            for (int x = 1; x <= size_.x; ++x) {
                row += world.get({x - 1, y - 1, z - 1}) != VoxelWorld::kEmpty ? 1 : 0;
                below_[index({x, y, z})] = row + below_[index({x, y - 1, z})] + below_[index({x, y, z - 1})] -
                                           below_[index({x, y - 1, z - 1})];
            }
        }
    }
}

std::size_t FilledCount::index(glm::ivec3 c) const {
    return static_cast<std::size_t>(c.x) +
           static_cast<std::size_t>(size_.x + 1) *
               (static_cast<std::size_t>(c.y) +
                static_cast<std::size_t>(size_.y + 1) * static_cast<std::size_t>(c.z));
}

int FilledCount::in_box(glm::ivec3 low, glm::ivec3 high) const {
    const glm::ivec3 a = glm::clamp(low, glm::ivec3(0), size_);
    const glm::ivec3 b = glm::clamp(high, a, size_);
    const auto at = [&](int x, int y, int z) { return below_[index({x, y, z})]; };
    return at(b.x, b.y, b.z) - at(a.x, b.y, b.z) - at(b.x, a.y, b.z) - at(b.x, b.y, a.z) + at(a.x, a.y, b.z) +
           at(a.x, b.y, a.z) + at(b.x, a.y, a.z) - at(a.x, a.y, a.z);
}

CellBox box_of(glm::ivec3 local, int log2, std::uint32_t distances, std::uint32_t bits) {
    const auto distance = [&](std::uint32_t direction) {
        return static_cast<int>((distances >> (direction * bits)) & ((1u << bits) - 1u));
    };
    const glm::ivec3 low(distance(0), distance(2), distance(4));
    const glm::ivec3 high(distance(1), distance(3), distance(5));
    const glm::ivec3 cell = local >> log2;
    return {(cell - low) * (1 << log2), (cell + high + 1) * (1 << log2)};
}

namespace {

class Inspection {
  public:
    Inspection(const VoxelWorld& world, const FilledCount& filled, const MarchWorld& built)
        : world_(world), filled_(filled), built_(built) {}

    std::string run() {
        const glm::ivec3 chunks = built_.chunks_size;
        for (int z = 0; z < chunks.z && lie_.empty(); ++z)
            for (int y = 0; y < chunks.y; ++y)
                for (int x = 0; x < chunks.x; ++x)
                    inspect(glm::ivec3(x, y, z) * 16, gpu::kChunkLog2);
        return lie_;
    }

  private:
    // All cells inside the cube of edge 2^log2, each once.
    void inspect(glm::ivec3 corner, int log2) {
        if (!lie_.empty()) return;
        const gpu::MarchCell found = gpu::find_cell(built_, corner, built_.chunks_size);
        if (found.log2 >= log2) return judge(corner, found);
        const int half = 1 << (log2 - 1);
        for (int i = 0; i < 8; ++i)
            inspect(corner + half * glm::ivec3(i & 1, (i >> 1) & 1, i >> 2), log2 - 1);
    }

    void judge(glm::ivec3 corner, const gpu::MarchCell& found) {
        const glm::ivec3 end = corner + (1 << found.log2);
        const gpu::MarchCell other = gpu::find_cell(built_, end - 1, built_.chunks_size);
        if (other.cell != found.cell || other.log2 != found.log2)
            return report(corner, "does not cover its voxels");
        if (gpu::cell_state(found.cell) == gpu::kCellSolid)
            return judge_solid(corner, end, gpu::cell_payload(found.cell));
        if (gpu::cell_state(found.cell) != gpu::kCellEmpty)
            return report(corner, "is mixed without children");
        const CellBox box = box_of(corner, found.log2, gpu::cell_payload(found.cell), found.bits);
        if (filled_.in_box(box.low, box.high) != 0)
            report(corner, fmt::format("has a box from ({}, {}, {}) to ({}, {}, {}) that is not empty",
                                       box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z));
    }

    void judge_solid(glm::ivec3 corner, glm::ivec3 end, std::uint32_t material) {
        for (int z = corner.z; z < end.z; ++z)
            for (int y = corner.y; y < end.y; ++y)
                for (int x = corner.x; x < end.x; ++x)
                    if (world_.get({x, y, z}) != (gpu::kVoxelSolidBit | material))
                        return report(corner,
                                      fmt::format("is solid of material {}, the voxels are not", material));
    }

    void report(glm::ivec3 corner, const std::string& text) {
        if (lie_.empty())
            lie_ = fmt::format("{}: the cell at ({}, {}, {}) {}", name_of(built_.traversal), corner.x,
                               corner.y, corner.z, text);
    }

    const VoxelWorld& world_;
    const FilledCount& filled_;
    const MarchWorld& built_;
    std::string lie_;
};

}  // namespace

std::string first_lie(const VoxelWorld& world, const FilledCount& filled, const MarchWorld& built) {
    return Inspection(world, filled, built).run();
}

StoredDistances stored_distances(MarchWorld& built, glm::ivec3 local) {
    const auto traversal = static_cast<gpu::uint>(built.traversal);
    const gpu::MarchCell found = gpu::find_cell(built, local, built.chunks_size);
    if (growing_levels(built.traversal).empty()) return {};
    const int root = gpu::root_log2(traversal);
    std::uint32_t* cell = &built.roots[gpu::root_index(local, built.chunks_size, root)];
    if (gpu::cell_state(*cell) == gpu::kCellMixed && gpu::has_brick_nodes(traversal))
        cell = &built.nodes[gpu::cell_payload(*cell) * 64u + gpu::child_slot((local >> gpu::kBrickLog2) & 3)];
    if (gpu::cell_state(*cell) != gpu::kCellMixed) return {cell, 0, found.bits, found.log2};
    const std::uint32_t leaf = gpu::cell_payload(*cell) * 64u + gpu::child_slot(local & 3);
    return {&built.leaves[leaf / 2], 16 * (leaf % 2), found.bits, 0};
}

}  // namespace voxilux::test
