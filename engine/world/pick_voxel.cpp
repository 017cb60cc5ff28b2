#include "world/pick_voxel.h"

#include <cmath>
#include <limits>

#include "shared/world_cell.h"

namespace voxilux {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr int kChunk = 1 << gpu::kChunkLog2;

// Where a ray meets the planes lo and hi of an axis: entry and exit.
glm::dvec2 span_of(double start, double direction, double lo, double hi) {
    if (direction == 0.0) return start >= lo && start < hi ? glm::dvec2(-kNever, kNever) : glm::dvec2(kNever);
    const double a = (lo - start) / direction;
    const double b = (hi - start) / direction;
    return {std::min(a, b), std::max(a, b)};
}

// Where a ray leaves a box that it is in, and along which axis.
struct Exit {
    double distance = kNever;
    int axis = 0;
};

Exit exit_of(glm::dvec3 start, glm::dvec3 direction, glm::ivec3 lo, int edge) {
    Exit exit;
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0) continue;
        const double plane = direction[axis] > 0.0 ? lo[axis] + edge : lo[axis];
        const double distance = (plane - start[axis]) / direction[axis];
        if (distance < exit.distance) exit = {distance, axis};
    }
    return exit;
}

// The cell beyond a face of the box lo, lo + edge: exact along the axis, whatever rounding does to the place.
glm::ivec3 cell_beyond(glm::dvec3 start, glm::dvec3 direction, glm::ivec3 lo, int edge, const Exit& exit) {
    const glm::dvec3 place = start + direction * exit.distance;
    glm::ivec3 cell = glm::clamp(glm::ivec3(glm::floor(place)), lo, lo + edge - 1);
    cell[exit.axis] = direction[exit.axis] > 0.0 ? lo[exit.axis] + edge : lo[exit.axis] - 1;
    return cell;
}

}  // namespace

std::optional<PickedVoxel> pick_voxel(const VoxelWorld& world, glm::dvec3 start, glm::dvec3 direction) {
    const glm::dvec3 from = start - glm::dvec3(world.origin());
    const glm::ivec3 size = world.size();
    glm::dvec2 inside{0.0, kNever};
    glm::ivec3 normal(0);
    for (int axis = 0; axis < 3; ++axis) {
        const glm::dvec2 span = span_of(from[axis], direction[axis], 0.0, size[axis]);
        if (span.x > inside.x) {
            inside.x = span.x;
            normal = glm::ivec3(0);
            normal[axis] = direction[axis] > 0.0 ? -1 : 1;
        }
        inside.y = std::min(inside.y, span.y);
    }
    if (!(inside.x < inside.y)) return std::nullopt;
    const glm::dvec3 entry = from + direction * inside.x;
    glm::ivec3 cell = glm::clamp(glm::ivec3(glm::floor(entry)), glm::ivec3(0), size - 1);
    double distance = inside.x;
    while (world.contains(cell)) {
        const std::uint16_t voxel = world.get(cell);
        if (voxel != VoxelWorld::kEmpty)
            return PickedVoxel{cell + world.origin(), normal, voxel & gpu::kVoxelPayloadMask, distance};
        const bool is_empty_chunk = world.chunk(cell / kChunk) == nullptr;
        const int edge = is_empty_chunk ? kChunk : 1;
        const glm::ivec3 lo = cell / edge * edge;
        const Exit exit = exit_of(from, direction, lo, edge);
        cell = cell_beyond(from, direction, lo, edge, exit);
        normal = glm::ivec3(0);
        normal[exit.axis] = direction[exit.axis] > 0.0 ? -1 : 1;
        distance = exit.distance;
    }
    return std::nullopt;
}

}  // namespace voxilux
