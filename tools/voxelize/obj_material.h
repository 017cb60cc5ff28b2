#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "voxelize/load_mesh.h"
#include "voxelize/mesh_notes.h"
#include "voxelize/read_texture.h"

namespace tinyobj {
struct material_t;
}

namespace voxilux {

// Textures that were read so far, by name and wrap mode; one that cannot be read is noted and kept as
// nothing.
struct ObjTextures {
    std::filesystem::path folder;
    TexelBudget budget;
    std::map<std::string, std::optional<std::uint32_t>> known;
};

// Where a file that an OBJ or MTL names lies: inside `folder` as named, else there under its last name.
[[nodiscard]] std::filesystem::path find_beside(const std::filesystem::path& folder, const std::string& name);

// A material of an MTL file; its textures are added to `mesh`. Source: Wavefront MTL, and the fields Pm, Pr,
// map_Pm, map_Pr, Ke, map_Ke of its extension for physically based shading.
[[nodiscard]] MeshMaterial material_from_mtl(const tinyobj::material_t& mtl, ObjTextures& textures,
                                             Mesh& mesh, MeshNotes& notes);

}  // namespace voxilux
