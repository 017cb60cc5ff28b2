#pragma once

#include "scene/scene.h"

namespace voxilux::test {

// Every cell that instances fill: visit(scene cell, material). A cell that several fill comes once for each.
template <class Visit>
void for_each_scene_voxel(const Scene& scene, const Visit& visit) {
    for (const Instance& instance : scene.instances) {
        const VoxelModel& model = scene.models.at(instance.model);
        for (const Voxel& v : model.voxels)
            visit(world_cell(instance, model.size, {v.x, v.y, v.z}), v.material);
        for (const VoxelBox& box : model.boxes)
            for (int z = box.cells.lo.z; z < box.cells.hi.z; ++z)
                for (int y = box.cells.lo.y; y < box.cells.hi.y; ++y)
                    for (int x = box.cells.lo.x; x < box.cells.hi.x; ++x)
                        visit(world_cell(instance, model.size, {x, y, z}), box.material);
    }
}

}  // namespace voxilux::test
