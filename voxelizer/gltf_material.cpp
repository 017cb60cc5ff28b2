#include "voxelizer/gltf_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/checked_cast.h"
#include "voxelizer/mesh_uri.h"
#include "voxelizer/surface_look.h"

namespace voxilux {
namespace {

using tinygltf::Value;

// What all functions here read from and write to.
struct Reader {
    const GltfDocument& document;
    GltfMaterials& known;
    Mesh& mesh;
    MeshNotes& notes;
};

const Value* find_in(const Value* object, const char* key) {
    return object != nullptr && object->Has(key) ? &object->Get(key) : nullptr;
}

const Value* find_extension(const tinygltf::ExtensionMap& extensions, const char* name) {
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

double factor_in(const Value* object, const char* key, double fallback) {
    const Value* value = find_in(object, key);
    return value != nullptr && value->IsNumber() ? value->GetNumberAsDouble() : fallback;
}

int integer_in(const Value* object, const char* key, int fallback) {
    const Value* value = find_in(object, key);
    return value != nullptr && value->IsInt() ? value->GetNumberAsInt() : fallback;
}

// The numbers of a list in `object`; `fallback` where it has none.
std::vector<double> numbers_in(const Value* object, const char* key, std::vector<double> fallback) {
    const Value* list = find_in(object, key);
    if (list == nullptr || list->ArrayLen() != fallback.size()) return fallback;
    for (std::size_t i = 0; i < fallback.size(); ++i)
        fallback[i] = list->Get(static_cast<int>(i)).GetNumberAsDouble();
    return fallback;
}

TextureWrap wrap_of(int code, const std::string& name) {
    switch (code) {
        case TINYGLTF_TEXTURE_WRAP_REPEAT:
            return TextureWrap::repeat;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
            return TextureWrap::mirrored_repeat;
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
            return TextureWrap::clamp_to_edge;
        default:
            throw MeshFault(name + " is not a wrap mode of glTF");
    }
}

std::optional<TextureKey> read_texture_key(Reader& reader, std::size_t index) {
    const tinygltf::Model& model = reader.document.model;
    const tinygltf::Texture& texture = model.textures[index];
    const std::string name = fmt::format("textures[{}]", index);
    const auto image = checked_index(texture.source, model.images.size(), name + ".source", "images");
    if (!image) {
        ++reader.notes["a texture has no PNG or JPEG image and is left out"];
        return std::nullopt;
    }
    TextureKey key{.image = *image};
    if (const auto found =
            checked_index(texture.sampler, model.samplers.size(), name + ".sampler", "samplers")) {
        const tinygltf::Sampler& sampler = model.samplers[*found];
        key.wrap_u = wrap_of(sampler.wrapS, fmt::format("samplers[{}].wrapS", *found));
        key.wrap_v = wrap_of(sampler.wrapT, fmt::format("samplers[{}].wrapT", *found));
        key.is_nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    return key;
}

Texture read_image(Reader& reader, std::size_t index) {
    const tinygltf::Model& model = reader.document.model;
    const tinygltf::Image& image = model.images[index];
    const std::string own_name = fmt::format("images[{}]", index);
    std::string name = image.name;
    if (name.empty()) name = image.uri.empty() || is_data_uri(image.uri) ? own_name : image.uri;
    TexelBudget& budget = reader.known.budget;
    if (!image.uri.empty()) return decode_texture(uri_bytes(reader.document, image.uri), name, budget);
    const auto view =
        checked_index(image.bufferView, model.bufferViews.size(), own_name + ".bufferView", "bufferViews");
    if (!view) throw MeshFault(own_name + " has neither a uri nor a bufferView");
    return decode_texture(view_bytes(reader.document, *view), name, budget);
}

// Adds the texture of a key to the mesh. A missing or broken image loses its colours, not the mesh.
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
glm::dmat3 texture_transform(const Value* transform) {
    const std::vector<double> offset = numbers_in(transform, "offset", {0, 0});
    const std::vector<double> scale = numbers_in(transform, "scale", {1, 1});
    const double angle = factor_in(transform, "rotation", 0.0);
    const double c = std::cos(angle), s = std::sin(angle);
    return {glm::dvec3(c * scale[0], -s * scale[0], 0.0), glm::dvec3(s * scale[1], c * scale[1], 0.0),
            glm::dvec3(offset[0], offset[1], 1.0)};
}

// A reference to a texture, of the core format or of an extension.
struct TextureInfo {
    int index = -1;
    int uv_set = 0;
    const Value* transform = nullptr;
};

TextureInfo info_of(const tinygltf::TextureInfo& info) {
    const Value* transform = find_extension(info.extensions, "KHR_texture_transform");
    return {info.index, integer_in(transform, "texCoord", info.texCoord), transform};
}

TextureInfo info_of(const Value* info) {
    const Value* transform = find_in(find_in(info, "extensions"), "KHR_texture_transform");
    return {integer_in(info, "index", -1), integer_in(transform, "texCoord", integer_in(info, "texCoord", 0)),
            transform};
}

std::optional<TextureUse> read_texture_use(Reader& reader, const TextureInfo& info, const std::string& name,
                                           const MaterialUse& use) {
    const auto index =
        checked_index(info.index, reader.document.model.textures.size(), name + ".index", "textures");
    if (!index) return std::nullopt;
    if (info.uv_set != 0 && info.uv_set != 1) {
        ++reader.notes["a texture is left out: it reads texture coordinates beyond TEXCOORD_1"];
        return std::nullopt;
    }
    if (info.uv_set == 0 ? !use.has_uv0 : !use.has_uv1) {
        ++reader.notes["a texture is left out: a mesh has no texture coordinates for it"];
        return std::nullopt;
    }
    const auto texture_key = read_texture_key(reader, *index);
    if (!texture_key) return std::nullopt;
    const auto [found, is_new] = reader.known.textures.try_emplace(*texture_key);
    if (is_new) found->second = add_texture(reader, *texture_key);
    if (!found->second) return std::nullopt;
    return TextureUse{.texture = *found->second,
                      .uv_set = static_cast<std::uint32_t>(info.uv_set),
                      .transform = texture_transform(info.transform)};
}

float unit_number(double number) {
    return static_cast<float>(std::clamp(number, 0.0, 1.0));
}

glm::vec4 colour_factor(const std::vector<double>& v, const std::string& name) {
    if (v.size() != 4) throw MeshFault(fmt::format("{} has {} numbers, not 4", name, v.size()));
    return glm::clamp(glm::vec4(glm::dvec4(v[0], v[1], v[2], v[3])), 0.0f, 1.0f);
}

// A material of the file, and its name in messages.
struct Item {
    const tinygltf::Material& material;
    std::string name;
};

void read_metallic_roughness(Reader& reader, const Item& item, const MaterialUse& use,
                             MeshMaterial& material) {
    const tinygltf::PbrMetallicRoughness& pbr = item.material.pbrMetallicRoughness;
    const std::string name = item.name + ".pbrMetallicRoughness";
    material.base_color = colour_factor(pbr.baseColorFactor, name + ".baseColorFactor");
    material.base_color_texture =
        read_texture_use(reader, info_of(pbr.baseColorTexture), name + ".baseColorTexture", use);
    material.metallic = unit_number(pbr.metallicFactor);
    material.roughness = unit_number(pbr.roughnessFactor);
    // Roughness is visible only on metal and glass voxels.
    if (material.metallic > 0.0f || item.material.extensions.contains("KHR_materials_transmission"))
        material.metallic_roughness_texture = read_texture_use(reader, info_of(pbr.metallicRoughnessTexture),
                                                               name + ".metallicRoughnessTexture", use);
}

constexpr const char* kSpecularGlossinessName = "KHR_materials_pbrSpecularGlossiness";

// The diffuse part is the base colour of a material without metal; a voxel cannot show the specular colour.
void read_specular_glossiness(Reader& reader, const Item& item, const MaterialUse& use,
                              MeshMaterial& material) {
    const Value* old = find_extension(item.material.extensions, kSpecularGlossinessName);
    const std::string name = fmt::format("{}.extensions.{}", item.name, kSpecularGlossinessName);
    material.base_color =
        colour_factor(numbers_in(old, "diffuseFactor", {1, 1, 1, 1}), name + ".diffuseFactor");
    material.base_color_texture =
        read_texture_use(reader, info_of(find_in(old, "diffuseTexture")), name + ".diffuseTexture", use);
    material.metallic = 0.0f;
    material.roughness = 1.0f - unit_number(factor_in(old, "glossinessFactor", 1.0));
}

void read_emission(Reader& reader, const Item& item, const MaterialUse& use, MeshMaterial& material) {
    const std::vector<double>& v = item.material.emissiveFactor;
    if (v.size() != 3)
        throw MeshFault(fmt::format("{}.emissiveFactor has {} numbers, not 3", item.name, v.size()));
    const double strength = factor_in(
        find_extension(item.material.extensions, "KHR_materials_emissive_strength"), "emissiveStrength", 1.0);
    material.emissive = emission_in_range(glm::dvec3(v[0], v[1], v[2]) * strength, reader.notes);
    if (material.emissive == glm::vec3(0.0f)) return;
    material.emissive_texture =
        read_texture_use(reader, info_of(item.material.emissiveTexture), item.name + ".emissiveTexture", use);
}

AlphaMode alpha_mode_of(const Item& item) {
    const std::string& mode = item.material.alphaMode;
    if (mode == "OPAQUE") return AlphaMode::opaque;
    if (mode == "MASK") return AlphaMode::mask;
    if (mode == "BLEND") return AlphaMode::blend;
    throw MeshFault(item.name + ".alphaMode is none of OPAQUE, MASK, BLEND");
}

MeshMaterial read_material(Reader& reader, const MaterialUse& use) {
    if (!use.material) return {.name = "default"};
    const Item item = {reader.document.model.materials.at(*use.material),
                       fmt::format("materials[{}]", *use.material)};
    const tinygltf::ExtensionMap& extensions = item.material.extensions;
    MeshMaterial material{.name = item.material.name};
    if (extensions.contains(kSpecularGlossinessName))
        read_specular_glossiness(reader, item, use, material);
    else
        read_metallic_roughness(reader, item, use, material);
    if (extensions.contains(
            "KHR_materials_unlit")) {  // its colour is the base colour, and nothing else matters
        material.metallic = 0.0f;
        material.metallic_roughness_texture.reset();
    } else {
        read_emission(reader, item, use, material);
    }
    material.alpha_mode = alpha_mode_of(item);
    material.alpha_cutoff = static_cast<float>(std::max(item.material.alphaCutoff, 0.0));
    const Value* transmission = find_extension(extensions, "KHR_materials_transmission");
    material.transmission = unit_number(factor_in(transmission, "transmissionFactor", 0.0));
    if (find_in(transmission, "transmissionTexture") != nullptr)
        ++reader.notes["the texture of a transmission is left out: its factor counts everywhere"];
    const double ior = factor_in(find_extension(extensions, "KHR_materials_ior"), "ior", 1.5);
    constexpr double kLargestIor = 10.0;
    material.ior = static_cast<float>(ior >= 1.0 ? std::min(ior, kLargestIor) : 1.5);
    return material;
}

}  // namespace

std::uint32_t use_material(const GltfDocument& document, const MaterialUse& use, GltfMaterials& known,
                           Mesh& mesh, MeshNotes& notes) {
    if (const auto found = known.materials.find(use); found != known.materials.end()) return found->second;
    Reader reader{document, known, mesh, notes};
    mesh.materials.push_back(read_material(reader, use));
    const auto index = checked_cast<std::uint32_t>(mesh.materials.size() - 1, "materials");
    known.materials.emplace(use, index);
    return index;
}

}  // namespace voxilux
