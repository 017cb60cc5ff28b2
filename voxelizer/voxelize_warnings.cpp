#include "voxelizer/voxelize_warnings.h"

#include <fmt/format.h>

#include "voxelizer/vox_output.h"

namespace voxilux {
namespace {

void warn_of_solid(const SolidReport& solid, InsideRule inside, std::vector<std::string>& warnings) {
    const bool is_parity = inside == InsideRule::parity;
    if (solid.open_edges > 0) {
        const std::string outcome = is_parity
                                        ? fmt::format("{} rows of voxels are not filled", solid.open_rows)
                                        : "its inside is where the generalised winding number is above 1/2";
        warnings.push_back(
            fmt::format("the mesh is open: {} edges have no partner, {}", solid.open_edges, outcome));
    }
    if (solid.turned_edges > 0 && !is_parity) {
        warnings.push_back(
            fmt::format("the mesh is not oriented: at {} edges triangles face opposite sides{}",
                        solid.turned_edges, solid.open_edges > 0 ? "" : "; its inside is found by parity"));
    }
    if (solid.disputed > 0 && (is_parity || solid.turned_edges > 0)) {
        warnings.push_back(fmt::format(
            "the mesh overlaps itself: parity and winding number disagree on {} voxels of the inside",
            solid.disputed));
    }
}

}  // namespace

std::vector<std::string> warnings_of(const Mesh& mesh, const VoxelSet& set, InsideRule inside,
                                     const PaletteError& error) {
    std::vector<std::string> warnings = mesh.warnings;
    if (set.dropped != 0)
        warnings.push_back(fmt::format(
            "{} {} not finite are left out", set.dropped,
            mesh.triangles.empty() ? "points whose place is" : "triangles with a vertex that is"));
    warn_of_solid(set.solid, inside, warnings);
    if (const auto range = range_warning(set.grid)) warnings.push_back(*range);
    if (error.radiances_off > 0) {
        warnings.push_back(
            fmt::format("{} voxels emit over 3 % more or less than the mesh says: 255 colours "
                        "are too few",
                        error.radiances_off));
    }
    return warnings;
}

}  // namespace voxilux
