#include "support/edited_scene.h"
#include "support/scene_voxels.h"

#include <map>
#include <tuple>

namespace voxilux::test {
namespace {

using Cells = std::map<std::tuple<int, int, int>, std::uint16_t>;

Cells cells_of(const Scene& scene) {
    Cells cells;
    for_each_scene_voxel(scene, [&](glm::ivec3 at, std::uint16_t material) {
        cells[{at.x, at.y, at.z}] = material;
    });
    return cells;
}

void apply(const BoxEdit& edit, Cells& cells) {
    if (!edit.material) {
        std::erase_if(cells, [&](const auto& cell) {
            const auto [x, y, z] = cell.first;
            const Box& box = edit.box;
            return x >= box.lo.x && y >= box.lo.y && z >= box.lo.z && x < box.hi.x && y < box.hi.y &&
                   z < box.hi.z;
        });
        return;
    }
    for (int x = edit.box.lo.x; x < edit.box.hi.x; ++x)
        for (int y = edit.box.lo.y; y < edit.box.hi.y; ++y)
            for (int z = edit.box.lo.z; z < edit.box.hi.z; ++z)
                cells[{x, y, z}] = static_cast<std::uint16_t>(*edit.material);
}

}  // namespace

Scene edited_scene(const Scene& scene, std::span<const BoxEdit> edits) {
    Cells cells = cells_of(scene);
    for (const BoxEdit& edit : edits)
        apply(edit, cells);
    Scene edited = scene;
    edited.models.clear();
    edited.instances.clear();
    if (cells.empty()) return edited;
    Box box;
    for (const auto& [cell, material] : cells) {
        const glm::ivec3 at(std::get<0>(cell), std::get<1>(cell), std::get<2>(cell));
        box = united(box, {at, at + 1});
    }
    VoxelModel model{.name = "edited", .size = box.hi - box.lo};
    for (const auto& [cell, material] : cells) {
        const glm::ivec3 at = glm::ivec3(std::get<0>(cell), std::get<1>(cell), std::get<2>(cell)) - box.lo;
        model.voxels.push_back({static_cast<std::uint16_t>(at.x), static_cast<std::uint16_t>(at.y),
                                static_cast<std::uint16_t>(at.z), material});
    }
    edited.instances.push_back({.model = 0, .translation = box.lo + model.size / 2});
    edited.models.push_back(std::move(model));
    return edited;
}

}  // namespace voxilux::test
