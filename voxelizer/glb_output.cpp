#include "voxelizer/glb_output.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <set>
#include <span>
#include <tuple>

#include <stb_image_write.h>
#include <nlohmann/json.hpp>

#include "base/assert.h"
#include "base/error.h"
#include "base/json.h"
#include "scene/vox_material.h"
#include "voxelizer/greedy_mesh.h"

namespace voxilux {
namespace {

using Json = nlohmann::ordered_json;

// Constants of the glTF 2.0 specification.
constexpr int kFloat = 5126, kUnsignedInt = 5125, kArrayBuffer = 34962, kElementBuffer = 34963,
              kNearest = 9728, kClampToEdge = 33071;
constexpr std::uint32_t kGlbMagic = 0x46546C67, kGlbJsonChunk = 0x4E4F534A, kGlbBinChunk = 0x004E4942;

// Lengths in the file are 32-bit words. A quad has four corners of position, normal and uv, and six indices;
// the JSON of 255 materials and the palette stay far below the rest.
constexpr std::uint64_t kMaxGlbBytes = 0xFFFFFFFF, kBytesPerQuad = 4 * (3 + 3 + 2) * 4 + 6 * 4,
                        kMaxOtherBytes = std::uint64_t{1} << 20;
constexpr std::uint64_t kMaxQuads = (kMaxGlbBytes - kMaxOtherBytes) / kBytesPerQuad;

void put_word(std::vector<std::byte>& bytes, std::uint32_t word) {
    for (unsigned shift = 0; shift < 32; shift += 8)
        bytes.push_back(std::byte(word >> shift & 0xFF));
}

void put_float(std::vector<std::byte>& bytes, float value) {
    put_word(bytes, std::bit_cast<std::uint32_t>(value));
}

void put_vector(std::vector<std::byte>& bytes, glm::vec3 v) {
    for (int axis = 0; axis < 3; ++axis)
        put_float(bytes, v[axis]);
}

// Converts z up to y up.
glm::vec3 upright(glm::ivec3 v) {
    return {v.x, v.z, -v.y};
}

// The properties of a glTF material besides its colour; palette indices with equal ones share it.
struct GlbLook {
    bool emits = false;
    float gain = 1.0f;  // of the emission over the palette's colour
    float metallic = 0.0f, roughness = 1.0f, transmission = 0.0f, ior = 1.5f;

    auto operator<=>(const GlbLook&) const = default;
};

GlbLook look_of_entry(const Material& material) {
    GlbLook look{.metallic = material.metallic,
                 .roughness = material.roughness,
                 .transmission = material.transmission};
    if (look.transmission > 0.0f) look.ior = material.ior;
    const float albedo = std::max({material.albedo.r, material.albedo.g, material.albedo.b});
    const float emission = std::max({material.emission.r, material.emission.g, material.emission.b});
    look.emits = emission > 0.0f && albedo > 0.0f;
    if (look.emits) look.gain = emission / albedo;
    return look;
}

Json material_json(const GlbLook& look) {
    Json material = {{"pbrMetallicRoughness",
                      {{"baseColorTexture", {{"index", 0}}},
                       {"baseColorFactor", {1.0, 1.0, 1.0, 1.0}},
                       {"metallicFactor", look.metallic},
                       {"roughnessFactor", look.roughness}}}};
    if (look.transmission > 0.0f) {
        material["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = look.transmission;
        material["extensions"]["KHR_materials_ior"]["ior"] = look.ior;
    }
    if (look.emits) {
        material["emissiveTexture"]["index"] = 0;
        material["emissiveFactor"] = {1.0, 1.0, 1.0};
        material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = look.gain;
    }
    return material;
}

std::vector<std::byte> palette_png(const VoxFile& file) {
    std::vector<std::uint8_t> codes;
    for (const VoxColour& colour : file.palette)
        codes.insert(codes.end(), {colour.r, colour.g, colour.b});
    std::vector<std::byte> png;
    const auto append = [](void* bytes, void* data, int size) {
        const auto* first = static_cast<const std::byte*>(data);
        auto& into = *static_cast<std::vector<std::byte>*>(bytes);
        into.insert(into.end(), first, first + size);
    };
    const int width = static_cast<int>(file.palette.size());
    if (stbi_write_png_to_func(append, &png, width, 1, 3, codes.data(), 3 * width) == 0)
        throw Error(ExitCode::out_of_memory, "no memory for a palette");
    return png;
}

class GlbWriter {
  public:
    explicit GlbWriter(const VoxFile& file) {
        const std::vector<std::byte> png = palette_png(file);
        root_["asset"] = {{"version", "2.0"}, {"generator", "voxilux"}};
        root_["scene"] = 0;
        root_["scenes"][0]["nodes"] = Json::array({0});
        root_["nodes"][0]["mesh"] = 0;
        root_["samplers"][0] = {{"magFilter", kNearest},
                                {"minFilter", kNearest},
                                {"wrapS", kClampToEdge},
                                {"wrapT", kClampToEdge}};
        root_["textures"][0] = {{"source", 0}, {"sampler", 0}};
        root_["images"][0] = {{"mimeType", "image/png"}, {"bufferView", add_view(png, 0)}};
    }

    // Adds the quads of one look.
    void add_part(const GlbLook& look, const std::vector<VoxelQuad>& quads) {
        std::vector<std::byte> positions, normals, uvs, indices;
        glm::vec3 low(1e30f), high(-1e30f);
        std::uint32_t first = 0;
        for (const VoxelQuad& quad : quads) {
            glm::ivec3 along(0), across(0), out(0);
            along[(quad.axis + 1) % 3] = quad.size.x;
            across[(quad.axis + 2) % 3] = quad.size.y;
            out[quad.axis] = quad.is_positive ? 1 : -1;
            if (!quad.is_positive) std::swap(along, across);  // counter-clockwise seen from outside
            for (const glm::ivec3 corner : {glm::ivec3(0), along, along + across, across}) {
                const glm::vec3 at = upright(quad.low + corner);
                low = glm::min(low, at);
                high = glm::max(high, at);
                put_vector(positions, at);
                put_vector(normals, upright(out));
                put_float(uvs, (static_cast<float>(quad.index) - 0.5f) / 256.0f);
                put_float(uvs, 0.5f);
            }
            for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
                put_word(indices, first + corner);
            first += 4;
        }
        Json position = accessor(add_view(positions, kArrayBuffer), kFloat, first, "VEC3");
        position["min"] = {low.x, low.y, low.z};
        position["max"] = {high.x, high.y, high.z};
        Json attributes;
        attributes["POSITION"] = add("accessors", std::move(position));
        attributes["NORMAL"] =
            add("accessors", accessor(add_view(normals, kArrayBuffer), kFloat, first, "VEC3"));
        attributes["TEXCOORD_0"] =
            add("accessors", accessor(add_view(uvs, kArrayBuffer), kFloat, first, "VEC2"));
        const std::size_t index = add(
            "accessors", accessor(add_view(indices, kElementBuffer), kUnsignedInt, first / 4 * 6, "SCALAR"));
        const std::size_t material = add("materials", material_json(look));
        root_["meshes"][0]["primitives"].push_back(
            {{"attributes", attributes}, {"indices", index}, {"material", material}});
        if (look.transmission > 0.0f) extensions_.insert({"KHR_materials_ior", "KHR_materials_transmission"});
        if (look.emits) extensions_.insert("KHR_materials_emissive_strength");
    }

    [[nodiscard]] std::vector<std::byte> finish() {
        root_["buffers"][0]["byteLength"] = data_.size();
        root_["bufferViews"] = views_;
        if (!extensions_.empty()) root_["extensionsUsed"] = extensions_;
        std::string text = json_text(root_);
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const std::uint64_t total = 12 + 8 + text.size() + 8 + data_.size();
        VX_ASSERT(total <= kMaxGlbBytes);
        std::vector<std::byte> glb;
        glb.reserve(total);
        for (const std::size_t word : {std::size_t{kGlbMagic}, std::size_t{2}, std::size_t{total},
                                       text.size(), std::size_t{kGlbJsonChunk}})
            put_word(glb, static_cast<std::uint32_t>(word));
        const auto json = std::as_bytes(std::span(text));
        glb.insert(glb.end(), json.begin(), json.end());
        put_word(glb, static_cast<std::uint32_t>(data_.size()));
        put_word(glb, kGlbBinChunk);
        glb.insert(glb.end(), data_.begin(), data_.end());
        return glb;
    }

  private:
    std::size_t add(const char* list, Json item) {
        root_[list].push_back(std::move(item));
        return root_[list].size() - 1;
    }

    static Json accessor(std::size_t view, int component, std::uint32_t count, const char* type) {
        return {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}};
    }

    // `target` 0: none.
    std::size_t add_view(const std::vector<std::byte>& bytes, int target) {
        Json view = {{"buffer", 0}, {"byteOffset", data_.size()}, {"byteLength", bytes.size()}};
        if (target != 0) view["target"] = target;
        data_.insert(data_.end(), bytes.begin(), bytes.end());
        data_.resize((data_.size() + 3) / 4 * 4);
        views_.push_back(view);
        return views_.size() - 1;
    }

    Json root_;
    Json views_ = Json::array();
    std::set<std::string> extensions_;
    std::vector<std::byte> data_;
};

}  // namespace

GlbOutput glb_of(const VoxFile& file) {
    std::vector<std::string> ignored;  // the caller has the file's warnings
    const std::array<Material, 256> materials = vox_materials(file, ignored);
    std::array<bool, 256> is_clear{};
    for (std::size_t i = 1; i < 256; ++i)
        is_clear[i] = materials[i].transmission > 0.0f;
    std::vector<IndexedCell> cells = cells_of_file(file);
    if (cells.empty()) throw Error(ExitCode::input_refused, "no voxel is visible");
    GlbOutput output{.voxels = cells.size()};
    std::map<GlbLook, std::vector<VoxelQuad>> parts;
    for (const VoxelQuad& quad : greedy_quads(std::move(cells), is_clear, kMaxQuads)) {
        parts[look_of_entry(materials[quad.index])].push_back(quad);
        ++output.quads;
    }
    GlbWriter writer(file);
    for (const auto& [look, quads] : parts)
        writer.add_part(look, quads);
    output.bytes = writer.finish();
    return output;
}

}  // namespace voxilux
