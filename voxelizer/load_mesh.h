#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "voxelizer/mesh.h"

namespace voxilux {

// Limits of a mesh file while it is read. A file over a limit is refused before its memory is allocated.
struct MeshLimits {
    std::uint64_t vertices = std::uint64_t{1} << 27;
    std::uint64_t triangles = std::uint64_t{1} << 27;
    std::uint64_t parts = std::uint64_t{1} << 22;             // primitives of glTF meshes, once for each node
    std::uint64_t texels_per_image = std::uint64_t{1} << 26;  // 8192 x 8192
    std::uint64_t texels = std::uint64_t{1} << 29;            // of all images together
    std::uint64_t file_bytes = std::uint64_t{1} << 32;        // of each file that is read
};

struct MeshRequest {
    bool is_strict = false;            // every warning is an error
    std::optional<std::size_t> scene;  // of a glTF file; without it, the file's own choice
    bool allows_points = false;        // a .ply, .xyz or .las file needs no triangle
    MeshLimits limits;
};

// The extensions of files that load_mesh reads, as ".gltf, .glb, ...", and whether a file has one of them.
[[nodiscard]] std::string mesh_endings();
[[nodiscard]] bool is_mesh(const std::filesystem::path& path);

// The triangles, materials and textures of a mesh file; the extension selects the reader. Triangles with a
// vertex that is not finite are left out and counted in the warnings. Throws Error(input_refused) with one
// line that names the file: unknown extension, broken or unsupported content, a missing buffer, no triangles,
// and with is_strict any warning.
[[nodiscard]] Mesh load_mesh(const std::filesystem::path& path, const MeshRequest& request = {});

// What is wrong inside a mesh file, without its name, which load_mesh adds.
class MeshFault : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace voxilux
