#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "voxelizer/mesh.h"
#include "voxelizer/voxel_palette.h"
#include "voxelizer/voxelize_mesh.h"

namespace voxilux {

struct VoxOutput {
    std::size_t models = 0;
    std::uint64_t voxels = 0;
    std::uint64_t bytes = 0;
};

// A model whose first cell is the cell `low` of the scene.
struct PlacedModel {
    std::string name;
    glm::ivec3 low{0};
    glm::ivec3 size{0};
};

// Adds the nodes that place the models of the file, in their order: one transform each, in a group called
// `name` on a layer of that name.
void add_graph(VoxFile& file, std::span<const PlacedModel> models, const std::string& name);

// A warning for a grid whose cells are outside what MagicaVoxel shows; our own reader accepts them.
[[nodiscard]] std::optional<std::string> range_warning(const MeshGrid& grid);

// Writes the voxels as a .vox file: models of at most 256^3 with tight sizes on a grid, one transform each,
// in a group called `name`, with grid.origin at the origin; the palette, MATL, one layer, and the cameras of
// the mesh. Writes to a temporary name first. Throws Error(cannot_write).
VoxOutput write_voxels(const std::filesystem::path& file, const VoxelSet& set, const VoxelPalette& palette,
                       const Mesh& mesh, const std::string& name);

// The contents that read_vox would return for that file.
[[nodiscard]] VoxFile vox_file_of(const VoxelSet& set, const VoxelPalette& palette, const Mesh& mesh,
                                  const std::string& name);

}  // namespace voxilux
