#include "view/mesh_drop.h"

#include <fmt/format.h>

#include "base/print.h"
#include "voxelizer/load_mesh.h"
#include "voxelizer/vox_output.h"
#include "voxelizer/voxelize_warnings.h"

namespace voxilux {

std::string unused_name(const std::string& stem, const std::string& ending, int first) {
    for (int i = first;; ++i) {
        std::string name = i == 0 ? stem + ending : fmt::format("{}.{:03}{}", stem, i, ending);
        if (!std::filesystem::exists(name)) return name;
    }
}

VoxelizedMesh voxelize_drop(const std::filesystem::path& file) {
    const Mesh mesh = load_mesh(file);
    const VoxelizeRequest request;
    const VoxelSet set = voxelize_mesh(mesh, request);
    const VoxelPalette palette(set, false);
    for (const std::string& warning : warnings_of(mesh, set, request.inside, palette.error()))
        print_message("voxilux: warning: {}\n", warning);
    const std::string stem = file.stem().string();
    const std::string output = unused_name(stem, ".vox");
    const VoxOutput written = write_voxels(output, set, palette, mesh, stem);
    return {output,
            fmt::format("{} became {} voxels in {}", file.filename().string(), written.voxels, output)};
}

}  // namespace voxilux
