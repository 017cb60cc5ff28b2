#include "voxelizer/voxelize_points.h"

#include <algorithm>

#include "base/checked_cast.h"
#include "base/colour.h"
#include "voxelizer/cell_set.h"

namespace voxilux {
namespace {

struct PlacedPoint {
    std::uint64_t cell = 0;  // x fastest, 17 bits per axis
    std::uint32_t point = 0;
};

constexpr int kAxisBits = 17;
static_assert(kMaxCells <= 1 << kAxisBits);

std::uint64_t cell_number(glm::ivec3 cell) {
    return (static_cast<std::uint64_t>(cell.z) << kAxisBits | static_cast<std::uint64_t>(cell.y))
               << kAxisBits |
           static_cast<std::uint64_t>(cell.x);
}

glm::ivec3 cell_of(std::uint64_t number) {
    constexpr std::uint64_t kMask = (std::uint64_t{1} << kAxisBits) - 1;
    return {static_cast<int>(number & kMask), static_cast<int>(number >> kAxisBits & kMask),
            static_cast<int>(number >> 2 * kAxisBits)};
}

std::vector<PlacedPoint> placed_points(const Mesh& mesh, const MeshGrid& grid) {
    std::vector<PlacedPoint> placed;
    placed.reserve(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (!is_finite(mesh.positions[i])) continue;
        const glm::ivec3 cell(glm::floor(grid.to_grid(mesh.positions[i])));
        placed.push_back({cell_number(glm::clamp(cell, glm::ivec3(0), grid.cells - 1)),
                          checked_cast<std::uint32_t>(i, "points")});
    }
    std::ranges::sort(placed, {}, [](const PlacedPoint& p) { return std::pair(p.cell, p.point); });
    return placed;
}

glm::u8vec3 mean_colour(const Mesh& mesh, std::span<const PlacedPoint> points) {
    if (mesh.colors.empty()) return glm::u8vec3(255);
    glm::dvec3 sum(0.0);
    for (const PlacedPoint& point : points)
        sum += glm::dvec3(mesh.colors[point.point]);
    const glm::vec3 mean(sum / static_cast<double>(points.size()));
    return {srgb_code(mean.r), srgb_code(mean.g), srgb_code(mean.b)};
}

}  // namespace

VoxelSet voxelize_points(const Mesh& mesh, const GridRequest& request) {
    const MeshGrid grid = grid_of_points(mesh, request);
    const std::vector<PlacedPoint> points = placed_points(mesh, grid);
    VoxelCells cells;
    for (std::size_t i = 0; i < points.size();) {
        const std::size_t first = i;
        while (i < points.size() && points[i].cell == points[first].cell)
            ++i;
        cells.cells.push_back({cell_of(points[first].cell) - grid.origin,
                               mean_colour(mesh, std::span(points).subspan(first, i - first))});
    }
    VoxelSet set = voxel_set_of(std::move(cells));
    set.dropped = mesh.positions.size() - points.size();
    return set;
}

}  // namespace voxilux
