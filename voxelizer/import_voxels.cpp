#include "voxelizer/import_voxels.h"

#include <algorithm>

#include "base/error.h"
#include "base/file.h"
#include "base/printable.h"
#include "formats/voxel_cells.h"
#include "voxelizer/cell_set.h"
#include "voxelizer/load_mesh.h"
#include "voxelizer/vox_output.h"
#include "voxelizer/voxelize_points.h"
#include "voxelizer/voxelize_warnings.h"

namespace voxilux {
namespace {

std::string shown(const std::filesystem::path& path) {
    return printable(path.string(), kUncut);
}

// Makes a file of the set, and the note about it.
ImportedVoxels imported(const std::filesystem::path& path, const VoxelSet& set, const Mesh& mesh,
                        const std::string& origin) {
    const VoxelPalette palette(set, false);
    ImportedVoxels result{.file = vox_file_of(set, palette, mesh, path.stem().string())};
    result.file.warnings = warnings_of(mesh, set, InsideRule::winding, palette.error());
    const glm::ivec3 cells = set.grid.cells;
    result.note = fmt::format("{}: {}{} voxels in {} x {} x {}, {} colours", shown(path), origin, set.surface,
                              cells.x, cells.y, cells.z, palette.entries().size());
    if (palette.error().mean > 0.0)
        result.note += fmt::format(" (dE76 {:.2f} from its own on average)", palette.error().mean);
    return result;
}

VoxelCells load_cells(const std::filesystem::path& path, const VoxelFormat& format) {
    auto voxels = read_voxel_cells(format, read_file(path));
    if (!voxels) throw Error(ExitCode::input_refused, fmt::format("{}: {}", shown(path), voxels.reason()));
    return std::move(voxels).value();
}

std::string size_text(const GridRequest& grid) {
    return grid.metres_per_voxel ? fmt::format("--scale {}", *grid.metres_per_voxel)
                                 : fmt::format("--resolution {}", grid.resolution);
}

ImportedVoxels import_mesh(const std::filesystem::path& path, const GridRequest& grid) {
    const Mesh mesh = load_mesh(path, {.allows_points = true});
    if (mesh.triangles.empty())
        return imported(path, voxelize_points(mesh, grid), mesh,
                        fmt::format("{} points ({}): ", mesh.positions.size(), size_text(grid)));
    const VoxelSet set = voxelize_mesh(mesh, {.grid = grid});
    return imported(path, set, mesh,
                    fmt::format("{} triangles voxelized ({}): ", mesh.triangles.size(), size_text(grid)));
}

}  // namespace

bool is_importable(const std::filesystem::path& path) {
    return voxel_format_of(path) != nullptr || is_mesh(path);
}

std::string importable_endings() {
    std::string endings;
    for (const VoxelFormat& format : voxel_formats())
        endings += fmt::format("{}, ", format.ending);
    return endings + mesh_endings();
}

ImportedVoxels import_voxels(const std::filesystem::path& path, const GridRequest& grid) {
    const VoxelFormat* const format = voxel_format_of(path);
    if (format == nullptr) return import_mesh(path, grid);
    VoxelCells voxels = load_cells(path, *format);
    Mesh rest;  // carries warnings; it has no camera
    rest.warnings = std::move(voxels.warnings);
    return imported(path, voxel_set_of(std::move(voxels)), rest, "");
}

}  // namespace voxilux
