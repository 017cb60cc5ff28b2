#include "voxelizer/load_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "base/error.h"
#include "base/file.h"
#include "base/printable.h"
#include "voxelizer/load_gltf.h"
#include "voxelizer/load_obj.h"
#include "voxelizer/load_ply.h"
#include "voxelizer/load_stl.h"
#include "voxelizer/load_xyz.h"
#include "voxelizer/mesh_notes.h"

namespace voxilux {
namespace {

using LoadMesh = Mesh (*)(std::span<const std::byte>, const std::filesystem::path& folder, const MeshRequest&,
                          MeshNotes&);

constexpr std::string_view kEndings[] = {".gltf", ".glb", ".obj", ".stl", ".ply", ".xyz"};
constexpr LoadMesh kLoaders[] = {load_gltf, load_gltf, load_obj, load_stl, load_ply, load_xyz};
static_assert(std::size(kEndings) == std::size(kLoaders));

// The place of a file's ending in kEndings, or their number.
std::size_t kind_of(const std::filesystem::path& path) {
    const auto found =
        std::ranges::find_if(kEndings, [&](std::string_view ending) { return has_ending(path, ending); });
    return static_cast<std::size_t>(found - std::begin(kEndings));
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

std::span<const std::string_view> mesh_endings() {
    return kEndings;
}

bool is_mesh(const std::filesystem::path& path) {
    return kind_of(path) < std::size(kEndings);
}

Mesh load_mesh(const std::filesystem::path& path, const MeshRequest& request) {
    const auto refuse = [&](const std::string& reason) {
        return Error(ExitCode::input_refused,
                     fmt::format("{}: {}", printable(path.string(), kUncut), printable(reason)));
    };
    if (!is_mesh(path)) throw refuse(fmt::format("not a mesh: {} files are read", fmt::join(kEndings, ", ")));
    const std::vector<std::byte> bytes = read_file(path, request.limits.file_bytes);
    MeshNotes notes;
    Mesh mesh;
    try {
        mesh = kLoaders[kind_of(path)](bytes, path.parent_path(), request, notes);
    } catch (const MeshFault& fault) {
        throw refuse(fault.what());
    }
    drop_unread_coordinates(mesh);
    mesh.warnings = note_lines(notes);
    const bool may_be_cloud = has_ending(path, ".ply") || has_ending(path, ".xyz");
    if (mesh.triangles.empty() && may_be_cloud && !request.allows_points)
        throw refuse("a cloud of points; 'voxilux convert' makes it voxels");
    if (mesh.triangles.empty() && !may_be_cloud)
        throw refuse(mesh.warnings.empty() ? "no triangles"
                                           : "no triangles are left: " + mesh.warnings.front());
    if (request.is_strict && !mesh.warnings.empty()) throw refuse(mesh.warnings.front() + " (--strict)");
    return mesh;
}

}  // namespace voxilux
