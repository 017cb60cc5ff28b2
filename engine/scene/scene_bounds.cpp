#include "scene/scene_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/parallel_blocks.h"

namespace voxilux {
namespace {

constexpr std::size_t kVoxelsOfBoxThread = std::size_t{1} << 17;

Box voxel_box(std::span<const Voxel> voxels) {
    if (voxels.empty()) return {};
    std::array<std::uint16_t, 3> low, high;
    low.fill(std::numeric_limits<std::uint16_t>::max());
    high.fill(0);
    for (const Voxel& voxel : voxels) {
        low = {std::min(low[0], voxel.x), std::min(low[1], voxel.y), std::min(low[2], voxel.z)};
        high = {std::max(high[0], voxel.x), std::max(high[1], voxel.y), std::max(high[2], voxel.z)};
    }
    return {{low[0], low[1], low[2]}, glm::ivec3(high[0], high[1], high[2]) + 1};
}

// What world_cell computes, in 64 bits. With everything doubled v + 1/2 - pivot is an odd integer, a rotation
// keeps it odd, and (odd - 1) / 2 is its floor.
std::int64_t wide_world_coordinate(const Instance& instance, glm::ivec3 size, glm::ivec3 v, int axis) {
    const std::size_t to = static_cast<std::size_t>(axis);
    const int from = instance.rotation.axis[to];
    const std::int64_t pivot = size[from] / 2;
    const std::int64_t odd = 2 * std::int64_t{v[from]} + 1 - 2 * pivot;
    return (instance.rotation.sign[to] * odd - 1) / 2 + instance.translation[axis];
}

int checked_coordinate(double value, std::string_view what) {
    if (!(std::abs(value) <= kMaxCoordinate))
        throw Error(
            ExitCode::input_refused,
            fmt::format(
                "the scene has a {} at coordinate {}, beyond the limit of 2^30 voxels from the origin: "
                "move it closer",
                what, value));
    return static_cast<int>(value);
}

Box instance_bounds(const Instance& instance, const VoxelModel& model, const Box& local) {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t a = wide_world_coordinate(instance, model.size, local.lo, axis);
        const std::int64_t b = wide_world_coordinate(instance, model.size, local.hi - 1, axis);
        box.lo[axis] = checked_coordinate(static_cast<double>(std::min(a, b)), "voxel");
        box.hi[axis] = checked_coordinate(static_cast<double>(std::max(a, b) + 1), "voxel");
    }
    return box;
}

Box bounds_of(const Sphere& sphere) {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
        box.lo[axis] = checked_coordinate(std::floor(sphere.centre[axis] - sphere.radius), "sphere");
        box.hi[axis] = checked_coordinate(std::ceil(sphere.centre[axis] + sphere.radius), "sphere");
    }
    return box;
}

}  // namespace

std::vector<Box> voxel_boxes(std::span<const VoxelModel> models) {
    std::size_t voxels = 0;
    for (const VoxelModel& model : models)
        voxels += model.voxels.size();
    std::vector<Box> boxes(models.size());
    for_each_block(models.size(), threads_for(voxels, kVoxelsOfBoxThread),
                   [&] { return [&](std::size_t i) { boxes[i] = voxel_box(models[i].voxels); }; });
    return boxes;
}

Box voxel_bounds(std::span<const VoxelModel> models, std::span<const Instance> instances) {
    std::vector<Box> local = voxel_boxes(models);
    for (std::size_t i = 0; i < models.size(); ++i)
        for (const VoxelBox& box : models[i].boxes)
            local[i] = united(local[i], box.cells);
    Box box;
    for (const Instance& instance : instances) {
        VX_ASSERT(instance.model < models.size());
        if (local[instance.model].empty()) continue;
        box = united(box, instance_bounds(instance, models[instance.model], local[instance.model]));
    }
    return box;
}

Box voxel_bounds(const Scene& scene) {
    return voxel_bounds(scene.models, scene.instances);
}

Box sphere_bounds(std::span<const Sphere> spheres) {
    Box box;
    for (const Sphere& sphere : spheres)
        box = united(box, bounds_of(sphere));
    return box;
}

Box scene_bounds(const Scene& scene) {
    return united(voxel_bounds(scene), sphere_bounds(scene.spheres));
}

}  // namespace voxilux
