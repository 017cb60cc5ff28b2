#include "voxelizer/mesh_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/checked_cast.h"
#include "base/error.h"

namespace voxilux {
namespace {

constexpr std::array<std::string_view, 6> kUpNames = {"x",  "y",  "z",
                                                      "-x", "-y", "-z"};  // in the order of UpAxis

// In voxels: rounding of an extent that is a whole number of cells must not add a layer.
constexpr double kExtentSlack = 1e-6;

bool has_finite_corners(const Mesh& mesh, const MeshTriangle& triangle) {
    for (int corner = 0; corner < 3; ++corner) {
        if (!is_finite(mesh.positions[triangle.vertices[corner]])) return false;
    }
    return true;
}

// A matrix whose rows are the axes of the grid in mesh space.
glm::dmat3 rows(glm::dvec3 x, glm::dvec3 y, glm::dvec3 z) {
    return glm::transpose(glm::dmat3(x, y, z));
}

glm::dmat3 axes_of(UpAxis up, int quarter_turns) {
    const glm::dvec3 x{1, 0, 0};
    const glm::dvec3 y{0, 1, 0};
    const glm::dvec3 z{0, 0, 1};
    const std::array<glm::dmat3, 6> upright = {rows(y, z, x),  rows(x, -z, y), rows(x, y, z),
                                               rows(z, y, -x), rows(x, z, -y), rows(x, -y, -z)};
    glm::dmat3 axes = upright[static_cast<std::size_t>(up)];
    const glm::dmat3 quarter = rows(-y, x, z);
    for (int turn = 0; turn < (quarter_turns % 4 + 4) % 4; ++turn)
        axes = quarter * axes;
    return axes;
}

int cells_along(double extent) {
    const double cells = std::ceil(extent - kExtentSlack);
    if (!(cells <= kMaxCells)) {
        throw Error(
            ExitCode::usage,
            fmt::format("a grid of {:.0f} cells on an axis, over {}: voxelize coarser", cells, kMaxCells));
    }
    return std::max(1, static_cast<int>(cells));
}

// The bounding box of what a grid must hold, in the grid's axes.
class GridBox {
  public:
    explicit GridBox(const glm::dmat3& axes) : axes_(axes) {}

    void add(const glm::dvec3& position) {
        const glm::dvec3 p = axes_ * position;
        low_ = glm::min(low_, p);
        high_ = glm::max(high_, p);
    }
    [[nodiscard]] bool is_empty() const { return low_.x > high_.x; }
    [[nodiscard]] MeshGrid grid(const GridRequest& request) const {
        MeshGrid grid{.axes = axes_, .low = low_};
        const glm::dvec3 extent = high_ - low_;
        const double longest = std::max({extent.x, extent.y, extent.z});
        if (!std::isfinite(longest))
            throw Error(ExitCode::input_refused, "the mesh is too large: its extent is not finite");
        // A mesh that is a single point fills one cell at any scale.
        grid.scale = request.metres_per_voxel ? 1.0 / *request.metres_per_voxel
                                              : request.resolution / (longest > 0.0 ? longest : 1.0);
        if (!std::isfinite(grid.scale) || grid.scale <= 0.0)
            throw Error(ExitCode::input_refused,
                        "the mesh is too large or too small to be scaled to the grid");
        for (int axis = 0; axis < 3; ++axis)
            grid.cells[axis] = cells_along(extent[axis] * grid.scale);
        grid.origin = grid.cells / 2;
        if (request.is_on_floor) grid.origin.z = 0;
        return grid;
    }

  private:
    glm::dmat3 axes_;
    glm::dvec3 low_ = glm::dvec3(std::numeric_limits<double>::infinity());
    glm::dvec3 high_ = -low_;
};

}  // namespace

std::string_view name_of(UpAxis up) {
    return kUpNames[static_cast<std::size_t>(up)];
}

std::optional<UpAxis> parse_up(std::string_view word) {
    const auto found = std::ranges::find(kUpNames, word);
    if (found == kUpNames.end()) return std::nullopt;
    return static_cast<UpAxis>(found - kUpNames.begin());
}

std::vector<std::uint32_t> finite_triangles(const Mesh& mesh) {
    std::vector<std::uint32_t> kept;
    kept.reserve(mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (has_finite_corners(mesh, mesh.triangles[i]))
            kept.push_back(checked_cast<std::uint32_t>(i, "triangle"));
    }
    return kept;
}

UpAxis up_of(const Mesh& mesh, const GridRequest& request) {
    return request.up.value_or(mesh.is_z_up ? UpAxis::z : UpAxis::y);
}

MeshGrid grid_of(const Mesh& mesh, const GridRequest& request) {
    GridBox box(axes_of(up_of(mesh, request), request.quarter_turns));
    for (const std::uint32_t index : finite_triangles(mesh)) {
        for (int corner = 0; corner < 3; ++corner)
            box.add(mesh.positions[mesh.triangles[index].vertices[corner]]);
    }
    if (box.is_empty()) throw Error(ExitCode::input_refused, "the mesh has no triangle to voxelize");
    return box.grid(request);
}

MeshGrid grid_of_points(const Mesh& mesh, const GridRequest& request) {
    GridBox box(axes_of(up_of(mesh, request), request.quarter_turns));
    for (const glm::dvec3& p : mesh.positions) {
        if (is_finite(p)) box.add(p);
    }
    if (box.is_empty()) throw Error(ExitCode::input_refused, "the cloud has no point whose place is finite");
    return box.grid(request);
}

std::vector<glm::ivec3> lattice_positions(const Mesh& mesh, const MeshGrid& grid) {
    std::vector<glm::ivec3> lattice;
    lattice.reserve(mesh.positions.size());
    const glm::dvec3 last = glm::dvec3(grid.cells) * double{kUnit} - 1.0;
    for (const glm::dvec3& p : mesh.positions) {
        const glm::dvec3 at = grid.to_grid(p) * double{kUnit};
        lattice.push_back(is_finite(at) ? glm::ivec3(glm::clamp(glm::round(at), glm::dvec3(0.0), last))
                                        : glm::ivec3(0));
    }
    return lattice;
}

}  // namespace voxilux
