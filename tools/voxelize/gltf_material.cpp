#include "voxelize/gltf_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/checked_cast.h"

namespace voxilux {
namespace {

// What all functions here read from and write to.
struct Reader {
    GltfDocument& document;
    GltfMaterials& known;
    Mesh& mesh;
    MeshNotes& notes;
};

TextureWrap read_wrap(const JsonItem& sampler, const char* key) {
    switch (read_count(sampler, key).value_or(10497)) {
        case 10497:
            return TextureWrap::repeat;
        case 33648:
            return TextureWrap::mirrored_repeat;
        case 33071:
            return TextureWrap::clamp_to_edge;
        default:
            throw MeshFault(fmt::format("{}.{} is not a wrap mode of glTF", sampler.name, key));
    }
}

std::optional<TextureKey> read_texture_key(Reader& reader, std::size_t index) {
    const JsonItem& root = reader.document.root;
    const JsonItem texture = list_item(root, "textures", index);
    const auto image = read_index(texture, "source", root, "images");
    if (!image) {
        ++reader.notes["a texture has no PNG or JPEG image and is left out"];
        return std::nullopt;
    }
    TextureKey key{.image = *image};
    if (const auto index_of_sampler = read_index(texture, "sampler", root, "samplers")) {
        const JsonItem sampler = list_item(root, "samplers", *index_of_sampler);
        key.wrap_u = read_wrap(sampler, "wrapS");
        key.wrap_v = read_wrap(sampler, "wrapT");
        key.is_nearest = read_count(sampler, "magFilter").value_or(9729) == 9728;
    }
    return key;
}

Texture read_image(Reader& reader, std::size_t index) {
    const JsonItem image = list_item(reader.document.root, "images", index);
    const std::string uri = read_text(image, "uri", "");
    std::string name = read_text(image, "name", "");
    if (name.empty()) name = uri.empty() || uri.starts_with("data:") ? image.name : uri;
    if (!uri.empty()) return decode_texture(uri_bytes(reader.document, uri), name, reader.known.budget);
    const auto view = read_index(image, "bufferView", reader.document.root, "bufferViews");
    if (!view) throw MeshFault(image.name + " has neither a uri nor a bufferView");
    return decode_texture(view_bytes(reader.document, *view), name, reader.known.budget);
}

// Adds the texture of a key to the mesh. A picture that is missing or broken costs its colours, not the mesh.
std::optional<std::uint32_t> add_texture(Reader& reader, const TextureKey& key) {
    try {
        Texture texture = read_image(reader, key.image);
        texture.wrap_u = key.wrap_u;
        texture.wrap_v = key.wrap_v;
        texture.is_nearest = key.is_nearest;
        reader.mesh.textures.push_back(std::move(texture));
        return checked_cast<std::uint32_t>(reader.mesh.textures.size() - 1, "textures");
    } catch (const MeshFault& fault) {
        ++reader.notes[fmt::format("a texture is left out: {}", fault.what())];
    }
    return std::nullopt;
}

// uv' = T R S uv. Source: KHR_texture_transform.
glm::dmat3 texture_transform(const JsonItem& transform) {
    std::array<double, 2> offset = {0, 0}, scale = {1, 1};
    read_numbers(transform, "offset", offset);
    read_numbers(transform, "scale", scale);
    const double angle = read_number(transform, "rotation", 0.0);
    const double c = std::cos(angle), s = std::sin(angle);
    return {glm::dvec3(c * scale[0], -s * scale[0], 0.0), glm::dvec3(s * scale[1], c * scale[1], 0.0),
            glm::dvec3(offset[0], offset[1], 1.0)};
}

std::optional<TextureUse> read_texture_use(Reader& reader, const JsonItem& owner, const char* key,
                                           const MaterialUse& use) {
    if (!has(owner, key)) return std::nullopt;
    const JsonItem info = child(owner, key);
    const auto index = read_index(info, "index", reader.document.root, "textures");
    if (!index) throw MeshFault(info.name + ".index is missing");
    const JsonItem transform = extension(info, "KHR_texture_transform");
    const std::uint64_t uv_set =
        read_count(transform, "texCoord").value_or(read_count(info, "texCoord").value_or(0));
    if (uv_set > 1) {
        ++reader.notes["a texture is left out: it reads texture coordinates beyond TEXCOORD_1"];
        return std::nullopt;
    }
    if (uv_set == 0 ? !use.has_uv0 : !use.has_uv1) {
        ++reader.notes["a texture is left out: a mesh has no texture coordinates for it"];
        return std::nullopt;
    }
    const auto texture_key = read_texture_key(reader, *index);
    if (!texture_key) return std::nullopt;
    const auto [found, is_new] = reader.known.textures.try_emplace(*texture_key);
    if (is_new) found->second = add_texture(reader, *texture_key);
    if (!found->second) return std::nullopt;
    return TextureUse{.texture = *found->second,
                      .uv_set = static_cast<std::uint32_t>(uv_set),
                      .transform = texture_transform(transform)};
}

float unit_number(const JsonItem& item, const char* key, double fallback) {
    return static_cast<float>(std::clamp(read_number(item, key, fallback), 0.0, 1.0));
}

glm::vec4 colour_factor(const JsonItem& item, const char* key) {
    std::array<double, 4> v = {1, 1, 1, 1};
    read_numbers(item, key, v);
    return glm::clamp(glm::vec4(glm::dvec4(v[0], v[1], v[2], v[3])), 0.0f, 1.0f);
}

void read_metallic_roughness(Reader& reader, const JsonItem& item, const MaterialUse& use,
                             MeshMaterial& material) {
    const JsonItem pbr = child(item, "pbrMetallicRoughness");
    material.base_color = colour_factor(pbr, "baseColorFactor");
    material.base_color_texture = read_texture_use(reader, pbr, "baseColorTexture", use);
    material.metallic = unit_number(pbr, "metallicFactor", 1.0);
    material.roughness = unit_number(pbr, "roughnessFactor", 1.0);
    // The roughness of what is neither metal nor glass does not show in a voxel.
    if (material.metallic > 0.0f || has(child(item, "extensions"), "KHR_materials_transmission"))
        material.metallic_roughness_texture = read_texture_use(reader, pbr, "metallicRoughnessTexture", use);
}

// Its diffuse part is the base colour of a material without metal; the specular colour has no place in a
// voxel.
void read_specular_glossiness(Reader& reader, const JsonItem& item, const MaterialUse& use,
                              MeshMaterial& material) {
    const JsonItem old = extension(item, "KHR_materials_pbrSpecularGlossiness");
    material.base_color = colour_factor(old, "diffuseFactor");
    material.base_color_texture = read_texture_use(reader, old, "diffuseTexture", use);
    material.metallic = 0.0f;
    material.roughness = 1.0f - unit_number(old, "glossinessFactor", 1.0);
    ++reader.notes["a material has specular colour and glossiness: its diffuse colour is read"];
}

void read_emission(Reader& reader, const JsonItem& item, const MaterialUse& use, MeshMaterial& material) {
    std::array<double, 3> v = {0, 0, 0};
    read_numbers(item, "emissiveFactor", v);
    const double strength =
        read_number(extension(item, "KHR_materials_emissive_strength"), "emissiveStrength", 1.0);
    constexpr double kBrightest = 1e6;  // keeps sums of many texels finite in floats
    for (int i = 0; i < 3; ++i)
        material.emissive[i] =
            static_cast<float>(std::clamp(v[static_cast<std::size_t>(i)] * strength, 0.0, kBrightest));
    if (material.emissive == glm::vec3(0.0f)) return;
    material.emissive_texture = read_texture_use(reader, item, "emissiveTexture", use);
}

AlphaMode read_alpha_mode(const JsonItem& item) {
    const std::string mode = read_text(item, "alphaMode", "OPAQUE");
    if (mode == "OPAQUE") return AlphaMode::opaque;
    if (mode == "MASK") return AlphaMode::mask;
    if (mode == "BLEND") return AlphaMode::blend;
    throw MeshFault(item.name + ".alphaMode is none of OPAQUE, MASK, BLEND");
}

MeshMaterial read_material(Reader& reader, const MaterialUse& use) {
    if (!use.material) return {.name = "default"};
    const JsonItem item = list_item(reader.document.root, "materials", *use.material);
    MeshMaterial material{.name = read_text(item, "name", "")};
    if (has(child(item, "extensions"), "KHR_materials_pbrSpecularGlossiness"))
        read_specular_glossiness(reader, item, use, material);
    else
        read_metallic_roughness(reader, item, use, material);
    read_emission(reader, item, use, material);
    material.alpha_mode = read_alpha_mode(item);
    material.alpha_cutoff = static_cast<float>(std::max(read_number(item, "alphaCutoff", 0.5), 0.0));
    material.transmission =
        unit_number(extension(item, "KHR_materials_transmission"), "transmissionFactor", 0.0);
    const double ior = read_number(extension(item, "KHR_materials_ior"), "ior", 1.5);
    constexpr double kLargestIor = 10.0;
    material.ior = static_cast<float>(ior >= 1.0 ? std::min(ior, kLargestIor) : 1.5);
    return material;
}

}  // namespace

std::uint32_t use_material(GltfDocument& document, const MaterialUse& use, GltfMaterials& known, Mesh& mesh,
                           MeshNotes& notes) {
    if (const auto found = known.materials.find(use); found != known.materials.end()) return found->second;
    Reader reader{document, known, mesh, notes};
    mesh.materials.push_back(read_material(reader, use));
    const auto index = checked_cast<std::uint32_t>(mesh.materials.size() - 1, "materials");
    known.materials.emplace(use, index);
    return index;
}

}  // namespace voxilux
