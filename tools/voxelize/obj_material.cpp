#include "voxelize/obj_material.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>

#include "base/checked_cast.h"
#include "base/error.h"
#include "base/file.h"
#include "voxelize/mesh_uri.h"

namespace voxilux {
namespace {

using tinyobj::real_t;

float unit(real_t value, float fallback) {
    return std::isfinite(value) ? static_cast<float>(std::clamp(value, real_t{0}, real_t{1})) : fallback;
}

glm::vec3 colour(const real_t* rgb) {
    return {unit(rgb[0], 1.0f), unit(rgb[1], 1.0f), unit(rgb[2], 1.0f)};
}

std::optional<std::uint32_t> add_texture(const std::string& name, bool is_clamped, ObjTextures& textures,
                                         Mesh& mesh, MeshNotes& notes) {
    try {
        const auto bytes = read_file(find_beside(textures.folder, name), textures.budget.limits.file_bytes);
        Texture texture = decode_texture(bytes, name, textures.budget);
        texture.wrap_u = texture.wrap_v = is_clamped ? TextureWrap::clamp_to_edge : TextureWrap::repeat;
        mesh.textures.push_back(std::move(texture));
        return checked_cast<std::uint32_t>(mesh.textures.size() - 1, "textures");
    } catch (const MeshFault& fault) {
        ++notes[fmt::format("a texture is left out: {}", fault.what())];
    } catch (const Error& error) {
        ++notes[fmt::format("a texture is left out: {}", error.what())];
    }
    return std::nullopt;
}

std::optional<TextureUse> texture_use(const std::string& name, const tinyobj::texture_option_t& option,
                                      ObjTextures& textures, Mesh& mesh, MeshNotes& notes) {
    if (name.empty()) return std::nullopt;
    const auto [found, is_new] = textures.known.try_emplace((option.clamp ? "c" : "r") + name);
    if (is_new) found->second = add_texture(name, option.clamp, textures, mesh, notes);
    if (!found->second) return std::nullopt;
    TextureUse use{.texture = *found->second};
    // Rows of a texture go down here, and v goes up in an OBJ file: the transform acts on v' = 1 - v.
    const auto finite = [](real_t value, double fallback) {
        return std::isfinite(value) ? static_cast<double>(value) : fallback;
    };
    const double su = finite(option.scale[0], 1.0), sv = finite(option.scale[1], 1.0);
    const double ou = finite(option.origin_offset[0], 0.0), ov = finite(option.origin_offset[1], 0.0);
    use.transform = {glm::dvec3(su, 0.0, 0.0), glm::dvec3(0.0, sv, 0.0), glm::dvec3(ou, 1.0 - sv - ov, 1.0)};
    return use;
}

}  // namespace

std::filesystem::path find_beside(const std::filesystem::path& folder, const std::string& name) {
    std::string path = name;
    std::ranges::replace(path, '\\', '/');
    std::error_code ignored;
    try {
        const std::filesystem::path inside = path_inside(folder, path);
        if (std::filesystem::exists(inside, ignored)) return inside;
    } catch (const MeshFault&) {
        // A path of another machine, or out of the folder: only its last name counts.
    }
    return path_inside(folder, path.substr(path.find_last_of('/') + 1));
}

MeshMaterial material_from_mtl(const tinyobj::material_t& mtl, ObjTextures& textures, Mesh& mesh,
                               MeshNotes& notes) {
    MeshMaterial material{.name = mtl.name};
    material.base_color = glm::vec4(colour(mtl.diffuse), unit(mtl.dissolve, 1.0f));
    material.base_color_texture = texture_use(mtl.diffuse_texname, mtl.diffuse_texopt, textures, mesh, notes);
    material.alpha_mode = material.base_color.a < 1.0f ? AlphaMode::blend : AlphaMode::opaque;
    if (!mtl.alpha_texname.empty()) ++notes["map_d is ignored: the material stays as opaque as its d says"];
    material.metallic = unit(mtl.metallic, 0.0f);
    // A Phong exponent s is about as wide as the microfacet roughness sqrt(2 / (s + 2)). Source: Walter et
    // al., Microfacet models for refraction through rough surfaces, EGSR 2007, section 5.2.
    const double shine =
        std::isfinite(mtl.shininess) ? std::max(static_cast<double>(mtl.shininess), 0.0) : 0.0;
    material.roughness =
        mtl.roughness > 0 ? unit(mtl.roughness, 1.0f) : static_cast<float>(std::sqrt(2.0 / (shine + 2.0)));
    for (int i = 0; i < 3; ++i)
        material.emissive[i] = std::isfinite(mtl.emission[i])
                                   ? std::clamp(static_cast<float>(mtl.emission[i]), 0.0f, 1e6f)
                                   : 0.0f;
    if (material.emissive != glm::vec3(0.0f))
        material.emissive_texture =
            texture_use(mtl.emissive_texname, mtl.emissive_texopt, textures, mesh, notes);
    const bool is_glass = mtl.illum == 4 || mtl.illum == 6 || mtl.illum == 7 || mtl.illum == 9;
    material.transmission = is_glass && material.base_color.a < 1.0f ? 1.0f - material.base_color.a : 0.0f;
    if (std::isfinite(mtl.ior) && mtl.ior > 1.0) material.ior = std::min(static_cast<float>(mtl.ior), 10.0f);
    return material;
}

}  // namespace voxilux
