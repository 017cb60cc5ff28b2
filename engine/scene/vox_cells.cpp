#include "scene/vox_cells.h"

#include <algorithm>

namespace voxilux {

bool is_inside(const VoxVoxel& voxel, glm::ivec3 size) {
    return voxel.x < size.x && voxel.y < size.y && voxel.z < size.z;
}

void count_oddities(VoxModel& model, VoxCells& cells) {
    model.out_of_size = 0;
    model.duplicates = 0;
    model.index0 = 0;
    for (const VoxVoxel& voxel : model.voxels) {
        if (!is_inside(voxel, model.size)) ++model.out_of_size;
        if (!cells.insert(voxel)) ++model.duplicates;
        if (voxel.index == 0) ++model.index0;
    }
    cells.forget(model.voxels);
}

bool has_oddities(const VoxModel& model) {
    return model.out_of_size != 0 || model.duplicates != 0 || model.index0 != 0;
}

std::vector<VoxVoxel> filled_voxels(const VoxModel& model, VoxCells& cells) {
    std::vector<VoxVoxel> filled;
    filled.reserve(model.voxels.size());
    for (auto voxel = model.voxels.rbegin(); voxel != model.voxels.rend(); ++voxel) {
        const bool wins = is_inside(*voxel, model.size) && cells.insert(*voxel);
        if (wins && voxel->index != 0) filled.push_back(*voxel);
    }
    cells.forget(model.voxels);
    std::reverse(filled.begin(), filled.end());
    return filled;
}

}  // namespace voxilux
