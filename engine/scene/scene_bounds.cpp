#include "scene/scene_bounds.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace voxilux {
namespace {

// The smallest box around the cells of a model, in model space.
Box model_bounds(const VoxelModel& model) {
    Box bounds;
    for (const Voxel& voxel : model.voxels) {
        const glm::ivec3 cell(voxel.x, voxel.y, voxel.z);
        bounds = united(bounds, {cell, cell + 1});
    }
    for (const VoxelBox& box : model.boxes)
        bounds = united(bounds, box.cells);
    return bounds;
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

Box voxel_bounds(std::span<const VoxelModel> models, std::span<const Instance> instances) {
    std::vector<Box> local;
    local.reserve(models.size());
    for (const VoxelModel& model : models)
        local.push_back(model_bounds(model));
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
