#include "renderer/editable_voxels.h"

#include <algorithm>

#include "base/error.h"
#include "shared/world_cell.h"

namespace voxilux {
namespace {

std::uint32_t material_of(std::uint16_t voxel) {
    return voxel & gpu::kVoxelPayloadMask;
}

bool touches_border(const Box& box, glm::ivec3 cell) {
    return glm::any(glm::equal(cell, box.lo)) || glm::any(glm::equal(cell, box.hi - 1));
}

// Adds what the cell was. Extends the last run of cells along x where the cell continues it.
void add_back(glm::ivec3 cell, std::optional<std::uint32_t> material, std::vector<BoxEdit>& back) {
    if (!back.empty()) {
        Box& run = back.back().box;
        const bool goes_on = back.back().material == material && run.hi.x == cell.x && run.lo.y == cell.y &&
                             run.lo.z == cell.z;
        if (goes_on) {
            ++run.hi.x;
            return;
        }
    }
    back.push_back({{cell, cell + 1}, material});
}

}  // namespace

EditableVoxels::EditableVoxels(const Scene& scene)
    : world_(build_world(scene)), counts_(scene.materials.size(), 0), box_(voxel_bounds(scene)) {
    world_.for_each_voxel([&](glm::ivec3, std::uint16_t voxel) { ++counts_.at(material_of(voxel)); });
}

void EditableVoxels::check(const BoxEdit& edit) const {
    if (glm::any(glm::lessThan(edit.box.lo, glm::ivec3(-kMaxCoordinate))) ||
        glm::any(glm::greaterThan(edit.box.hi, glm::ivec3(kMaxCoordinate))))
        throw Error(ExitCode::input_refused, "an edit reaches beyond 2^30 voxels from the origin");
    if (edit.material && *edit.material >= counts_.size())
        throw Error(ExitCode::input_refused, fmt::format("an edit sets material {}, but the scene has {}",
                                                         *edit.material, counts_.size()));
}

VoxelChange EditableVoxels::apply(std::span<const BoxEdit> edits) {
    Box box = box_;
    for (const BoxEdit& edit : edits) {
        check(edit);
        if (edit.material && !edit.paints) box = united(box, edit.box);
    }
    const WorldGrid before{world_.origin(), world_.chunks()};
    if (box != box_) move_to(grid_around(box));
    VoxelChange change;
    for (const BoxEdit& edit : edits) {
        const auto voxel = static_cast<std::uint16_t>(edit.material ? gpu::kVoxelSolidBit | *edit.material
                                                                    : VoxelWorld::kEmpty);
        const glm::ivec3 low = glm::max(edit.box.lo - world_.origin(), glm::ivec3(0));
        const glm::ivec3 high = glm::min(edit.box.hi - world_.origin(), world_.size());
        for (int z = low.z; z < high.z; ++z)
            for (int y = low.y; y < high.y; ++y)
                for (int x = low.x; x < high.x; ++x)
                    if (!edit.paints || world_.get({x, y, z}) != VoxelWorld::kEmpty)
                        put({x, y, z}, voxel, change);
    }
    // Where a cell has changed twice, the later change is undone first.
    std::ranges::reverse(change.back);
    if (may_shrink_) measure_box();
    if (const WorldGrid grid = grid_around(box_); grid != WorldGrid{world_.origin(), world_.chunks()})
        move_to(grid);
    change.has_moved = before != WorldGrid{world_.origin(), world_.chunks()};
    return change;
}

void EditableVoxels::put(glm::ivec3 local, std::uint16_t voxel, VoxelChange& change) {
    const std::uint16_t before = world_.get(local);
    if (before == voxel) return;
    const glm::ivec3 cell = local + world_.origin();
    if (before != VoxelWorld::kEmpty) --counts_[material_of(before)];
    if (voxel != VoxelWorld::kEmpty) {
        ++counts_[material_of(voxel)];
        box_ = united(box_, {cell, cell + 1});
    } else {
        may_shrink_ |= touches_border(box_, cell);
    }
    world_.put(local, voxel);
    change.cells.push_back({local, voxel});
    add_back(cell, before != VoxelWorld::kEmpty ? std::optional(material_of(before)) : std::nullopt,
             change.back);
}

// Moves the same voxels to a grid with another corner.
void EditableVoxels::move_to(const WorldGrid& grid) {
    VoxelWorld moved(grid.origin, grid.chunks);
    const glm::ivec3 shift = world_.origin() - grid.origin;
    world_.for_each_voxel([&](glm::ivec3 local, std::uint16_t voxel) { moved.put(local + shift, voxel); });
    world_ = std::move(moved);
}

void EditableVoxels::measure_box() {
    may_shrink_ = false;
    box_ = {};
    world_.for_each_voxel([&](glm::ivec3 local, std::uint16_t) {
        const glm::ivec3 cell = local + world_.origin();
        box_ = united(box_, {cell, cell + 1});
    });
}

VoxelFacts EditableVoxels::facts() const {
    VoxelFacts facts{.count = world_.voxel_count(), .box = box_};
    for (const std::uint64_t count : counts_)
        facts.used.push_back(count > 0);
    return facts;
}

}  // namespace voxilux
