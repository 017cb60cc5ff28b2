#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>

#include "voxelizer/gltf_document.h"
#include "voxelizer/mesh_notes.h"
#include "voxelizer/read_texture.h"

namespace voxilux {

// A material as a primitive uses it: textures whose coordinates the primitive lacks are left out.
struct MaterialUse {
    std::optional<std::size_t> material;  // of "materials"; the default one without
    bool has_uv0 = false;
    bool has_uv1 = false;
    auto operator<=>(const MaterialUse&) const = default;
};

struct TextureKey {
    std::size_t image = 0;
    TextureWrap wrap_u = TextureWrap::repeat;
    TextureWrap wrap_v = TextureWrap::repeat;
    bool is_nearest = false;
    auto operator<=>(const TextureKey&) const = default;
};

// Materials and textures read so far, by their keys. An image that cannot be read is noted and stored as
// absent.
struct GltfMaterials {
    std::map<MaterialUse, std::uint32_t> materials;
    std::map<TextureKey, std::optional<std::uint32_t>> textures;
    TexelBudget budget;
};

// The index of a material in mesh.materials. It is read, with its images, on first use. Source: glTF 2.0,
// section 3.9; the KHR_materials extensions of the same name as the fields.
[[nodiscard]] std::uint32_t use_material(const GltfDocument& document, const MaterialUse& use,
                                         GltfMaterials& known, Mesh& mesh, MeshNotes& notes);

}  // namespace voxilux
