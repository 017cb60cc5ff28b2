#include "voxelizer/load_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/error.h"
#include "base/file.h"
#include "base/printable.h"
#include "voxelizer/load_gltf.h"
#include "voxelizer/load_obj.h"
#include "voxelizer/mesh_notes.h"

namespace voxilux {
namespace {

std::string suffix_of(const std::filesystem::path& path) {
    std::string suffix = path.extension().string();
    std::ranges::transform(suffix, suffix.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return suffix;
}

// Texture coordinates that no texture reads would only take memory.
void drop_unread_coordinates(Mesh& mesh) {
    bool is_read[2] = {false, false};
    for (const MeshMaterial& material : mesh.materials) {
        for (const auto* use : {&material.base_color_texture, &material.metallic_roughness_texture,
                                &material.emissive_texture}) {
            if (*use) is_read[(*use)->uv_set] = true;
        }
    }
    if (!is_read[0]) mesh.uv0 = {};
    if (!is_read[1]) mesh.uv1 = {};
}

}  // namespace

Mesh load_mesh(const std::filesystem::path& path, const MeshRequest& request) {
    const auto refuse = [&](const std::string& reason) {
        return Error(ExitCode::input_refused,
                     fmt::format("{}: {}", printable(path.string(), kUncut), printable(reason)));
    };
    const std::string suffix = suffix_of(path);
    const bool is_gltf = suffix == ".gltf" || suffix == ".glb";
    if (!is_gltf && suffix != ".obj") throw refuse("not a mesh: .gltf, .glb and .obj files are read");
    const std::vector<std::byte> bytes = read_file(path, request.limits.file_bytes);
    MeshNotes notes;
    Mesh mesh;
    try {
        mesh = (is_gltf ? load_gltf : load_obj)(bytes, path.parent_path(), request, notes);
    } catch (const MeshFault& fault) {
        throw refuse(fault.what());
    }
    drop_unread_coordinates(mesh);
    mesh.warnings = note_lines(notes);
    if (mesh.triangles.empty())
        throw refuse(mesh.warnings.empty() ? "no triangles"
                                           : "no triangles are left: " + mesh.warnings.front());
    if (request.is_strict && !mesh.warnings.empty()) throw refuse(mesh.warnings.front() + " (--strict)");
    return mesh;
}

}  // namespace voxilux
