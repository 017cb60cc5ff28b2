#include "voxelizer/load_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "base/error.h"
#include "base/file.h"
#include "base/printable.h"
#include "voxelizer/load_gltf.h"
#include "voxelizer/load_las.h"
#include "voxelizer/load_obj.h"
#include "voxelizer/load_ply.h"
#include "voxelizer/load_stl.h"
#include "voxelizer/load_xyz.h"
#include "voxelizer/mesh_notes.h"

namespace voxilux {
namespace {

struct MeshFormat {
    std::string_view ending;
    Mesh (*load)(std::span<const std::byte>, const std::filesystem::path& folder, const MeshRequest&,
                 MeshNotes&);
    bool may_be_points = false;  // without triangles
};

constexpr MeshFormat kMeshFormats[] = {
    {".gltf", load_gltf},     {".glb", load_gltf},      {".obj", load_obj},      {".stl", load_stl},
    {".ply", load_ply, true}, {".xyz", load_xyz, true}, {".las", load_las, true}};

// The format of a file's extension, or nullptr.
const MeshFormat* mesh_format_of(const std::filesystem::path& path) {
    const auto found = std::ranges::find_if(
        kMeshFormats, [&](const MeshFormat& format) { return has_ending(path, format.ending); });
    return found == std::end(kMeshFormats) ? nullptr : found;
}

// Texture coordinates that no texture uses would only take memory.
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

std::string mesh_endings() {
    std::string endings;
    for (const MeshFormat& format : kMeshFormats)
        endings += fmt::format("{}{}", endings.empty() ? "" : ", ", format.ending);
    return endings;
}

bool is_mesh(const std::filesystem::path& path) {
    return mesh_format_of(path) != nullptr;
}

Mesh load_mesh(const std::filesystem::path& path, const MeshRequest& request) {
    const auto refuse = [&](const std::string& reason) {
        return Error(ExitCode::input_refused,
                     fmt::format("{}: {}", printable(path.string(), kUncut), printable(reason)));
    };
    const MeshFormat* const format = mesh_format_of(path);
    if (format == nullptr) throw refuse(fmt::format("not a mesh: {} files are read", mesh_endings()));
    const std::vector<std::byte> bytes = read_file(path, request.limits.file_bytes);
    MeshNotes notes;
    Mesh mesh;
    try {
        mesh = format->load(bytes, path.parent_path(), request, notes);
    } catch (const MeshFault& fault) {
        throw refuse(fault.what());
    }
    drop_unread_coordinates(mesh);
    mesh.warnings = note_lines(notes);
    if (mesh.triangles.empty() && format->may_be_points && !request.allows_points)
        throw refuse("a cloud of points; 'voxilux convert' makes it voxels");
    if (mesh.triangles.empty() && !format->may_be_points)
        throw refuse(mesh.warnings.empty() ? "no triangles"
                                           : "no triangles are left: " + mesh.warnings.front());
    if (request.is_strict && !mesh.warnings.empty()) throw refuse(mesh.warnings.front() + " (--strict)");
    return mesh;
}

}  // namespace voxilux
