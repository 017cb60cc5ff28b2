#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "voxelizer/load_mesh.h"
#include "voxelizer/mesh_notes.h"
#include "voxelizer/read_texture.h"

namespace voxilux {

// Materials and textures of the MTL files read so far, by name. A texture that cannot be read is noted and
// stored as absent.
struct MtlLibrary {
    std::filesystem::path folder;
    TexelBudget budget;
    std::map<std::string, std::uint32_t> materials;  // of Mesh::materials
    std::map<std::string, std::optional<std::uint32_t>> textures;
};

// Reads the text of an MTL file into `mesh` and `library`. Factors are linear. Source: Wavefront MTL, and the
// fields Pm, Pr, Ke and map_Ke of its extension for physically based shading. Throws MeshFault for an invalid
// number.
void read_mtl(std::string_view text, MtlLibrary& library, Mesh& mesh, MeshNotes& notes);

// The same for the file `name`; one that cannot be read is noted.
void load_mtl(const std::string& name, MtlLibrary& library, Mesh& mesh, MeshNotes& notes);

// The path of a file that an OBJ or MTL names: inside `folder` as named, else there under its last component,
// for paths of another machine. Throws MeshFault for a name that cannot be a file.
[[nodiscard]] std::filesystem::path find_beside(const std::filesystem::path& folder, const std::string& name);

}  // namespace voxilux
