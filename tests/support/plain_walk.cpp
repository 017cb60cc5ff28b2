#include "support/plain_walk.h"

namespace voxilux::test {
namespace {

template <class World>
gpu::MarchHit walk(const World& world, const gpu::Ray& ray, AxisOrder order) {
    const gpu::MarchAxes axes = gpu::march_axes(ray);
    gpu::MarchHit hit{};
    hit.cell = ray.cell;
    hit.face = gpu::kFaceMiss;
    if (!(ray.t_max > 0.0f)) return hit;
    int axis = -1;
    glm::vec3 times = gpu::plane_times(axes, glm::ivec3(1));
    while (world.contains(hit.cell)) {
        const std::uint16_t voxel = world.get(hit.cell);
        if (voxel != VoxelWorld::kEmpty) {
            hit.face = axis < 0 ? gpu::kFaceInside : static_cast<gpu::uint>(axes.direction_numbers[axis] ^ 1);
            hit.material = voxel & gpu::kVoxelPayloadMask;
            return hit;
        }
        axis = order[0];
        if (times[order[1]] < times[axis]) axis = order[1];
        if (times[order[2]] < times[axis]) axis = order[2];
        if (!(times[axis] < ray.t_max)) return hit;
        hit.t = times[axis];
        ++hit.crossed[axis];
        hit.cell[axis] += axes.sign_mask[axis] < 0 ? -1 : 1;
        ++hit.steps;
        times = gpu::plane_times(axes, hit.crossed + 1);
    }
    return hit;
}

}  // namespace

gpu::MarchHit walk_cells(const VoxelWorld& world, const gpu::Ray& ray, AxisOrder order) {
    return walk(world, ray, order);
}

DenseVoxels::DenseVoxels(const VoxelWorld& world)
    : size_(world.size()),
      voxels_(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) *
              static_cast<std::size_t>(size_.z)) {
    world.for_each_voxel(
        [&](glm::ivec3 c, std::uint16_t voxel) { voxels_[gpu::grid_index(c, size_)] = voxel; });
}

gpu::MarchHit walk_cells(const DenseVoxels& world, const gpu::Ray& ray, AxisOrder order) {
    return walk(world, ray, order);
}

}  // namespace voxilux::test
