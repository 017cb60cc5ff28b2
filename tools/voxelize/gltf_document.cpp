#include "voxelize/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "base/error.h"
#include "base/file.h"
#include "voxelize/mesh_notes.h"
#include "voxelize/mesh_uri.h"

namespace voxilux {
namespace {

using nlohmann::json;
using Bytes = std::span<const std::byte>;

constexpr std::uint32_t kMagic = 0x46546C67;        // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;  // "BIN"
constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;

// What a file may require. Those on materials change looks that a voxel can show, or are read as far as it
// can.
constexpr std::array<std::string_view, 8> kReadExtensions = {
    "KHR_texture_transform",      "KHR_mesh_quantization", "KHR_materials_emissive_strength",
    "KHR_materials_ior",          "KHR_materials_unlit",   "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_transmission", "KHR_lights_punctual",
};

std::uint32_t word_at(Bytes bytes, std::size_t offset) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i)
        word |= std::to_integer<std::uint32_t>(bytes[offset + i]) << (8 * i);
    return word;
}

struct GlbChunks {
    Bytes json;
    std::optional<Bytes> binary;
};

GlbChunks split_glb(Bytes bytes) {
    if (bytes.size() < kHeaderBytes) throw MeshFault("the GLB header is cut off");
    if (const std::uint32_t version = word_at(bytes, 4); version != 2)
        throw MeshFault(fmt::format("GLB version {} is not 2", version));
    if (const std::uint32_t length = word_at(bytes, 8); length != bytes.size())
        throw MeshFault(fmt::format("the GLB header says {} bytes, but there are {}", length, bytes.size()));
    GlbChunks chunks;
    std::size_t at = kHeaderBytes;
    for (std::size_t number = 0; at < bytes.size(); ++number) {
        if (bytes.size() - at < kChunkHeaderBytes)
            throw MeshFault(fmt::format("the header of GLB chunk {} is cut off", number));
        const std::size_t size = word_at(bytes, at);
        const std::uint32_t kind = word_at(bytes, at + 4);
        at += kChunkHeaderBytes;
        if (size > bytes.size() - at)
            throw MeshFault(
                fmt::format("GLB chunk {} has {} bytes, but {} are left", number, size, bytes.size() - at));
        if ((number == 0) != (kind == kJsonChunk))
            throw MeshFault("the first GLB chunk, and only that, is JSON");
        if (kind == kJsonChunk) chunks.json = bytes.subspan(at, size);
        if (kind == kBinaryChunk && !chunks.binary) chunks.binary = bytes.subspan(at, size);
        at += size;
    }
    if (chunks.json.empty()) throw MeshFault("the GLB file has no JSON chunk");
    return chunks;
}

json parse_json(Bytes bytes) {
    const auto* first = reinterpret_cast<const char*>(bytes.data());
    try {
        return json::parse(first, first + bytes.size());
    } catch (const json::parse_error& error) {
        throw MeshFault(fmt::format("not valid JSON at byte {}", error.byte));
    } catch (const json::exception&) {
        throw MeshFault("not valid JSON: a number is too large");
    }
}

void check_version(const JsonItem& root) {
    const std::string version = read_text(child(root, "asset"), "version", "");
    if (version.starts_with("2.")) return;
    if (version.empty()) throw MeshFault("asset.version is missing: glTF 2.0 is read");
    throw MeshFault(fmt::format("glTF {} is not read: export the mesh as glTF 2.0", quoted_name(version)));
}

void check_required_extensions(const JsonItem& root) {
    const auto list = root.json->find("extensionsRequired");
    if (list == root.json->end()) return;
    if (!list->is_array()) throw MeshFault("extensionsRequired is not an array");
    for (const json& value : *list) {
        if (!value.is_string()) throw MeshFault("extensionsRequired holds something that is not a text");
        const auto& name = value.get_ref<const std::string&>();
        if (std::ranges::find(kReadExtensions, name) == kReadExtensions.end())
            throw MeshFault(fmt::format(
                "needs the extension {}, which is not read: export the mesh without it", quoted_name(name)));
    }
}

const std::vector<std::byte>& buffer_bytes(GltfDocument& document, std::size_t index) {
    auto& bytes = document.buffers.at(index);
    if (bytes) return *bytes;
    const JsonItem buffer = list_item(document.root, "buffers", index);
    const std::uint64_t length = require_count(buffer, "byteLength");
    if (has(buffer, "uri")) {
        bytes = uri_bytes(document, read_text(buffer, "uri", ""));
    } else {
        if (index != 0 || !document.binary)
            throw MeshFault(buffer.name + " has neither a uri nor a GLB chunk");
        bytes = std::move(*document.binary);
    }
    if (bytes->size() < length) {
        const std::size_t size = bytes->size();
        throw MeshFault(fmt::format("{} should have {} bytes, but has {}", buffer.name, length, size));
    }
    bytes->resize(static_cast<std::size_t>(length));
    return *bytes;
}

}  // namespace

GltfDocument parse_gltf(Bytes bytes, const std::filesystem::path& folder, const MeshLimits& limits) {
    GltfDocument document;
    document.folder = folder;
    document.limits = limits;
    Bytes text = bytes;
    if (bytes.size() >= 4 && word_at(bytes, 0) == kMagic) {
        const GlbChunks chunks = split_glb(bytes);
        text = chunks.json;
        if (chunks.binary) document.binary.emplace(chunks.binary->begin(), chunks.binary->end());
    }
    document.json = std::make_shared<const json>(parse_json(text));
    if (!document.json->is_object()) throw MeshFault("the JSON is not an object");
    document.root = {document.json.get(), ""};
    check_version(document.root);
    check_required_extensions(document.root);
    document.buffers.resize(list_size(document.root, "buffers"));
    return document;
}

Bytes view_bytes(GltfDocument& document, std::size_t index) {
    const JsonItem view = list_item(document.root, "bufferViews", index);
    const auto buffer = read_index(view, "buffer", document.root, "buffers");
    if (!buffer) throw MeshFault(view.name + ".buffer is missing");
    const Bytes bytes = buffer_bytes(document, *buffer);
    const std::uint64_t offset = read_count(view, "byteOffset").value_or(0);
    const std::uint64_t length = require_count(view, "byteLength");
    if (offset > bytes.size() || length > bytes.size() - offset)
        throw MeshFault(
            fmt::format("{} reaches byte {} of a buffer of {}", view.name, offset + length, bytes.size()));
    return bytes.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
}

std::vector<std::byte> uri_bytes(const GltfDocument& document, const std::string& uri) {
    if (is_data_uri(uri)) return decode_data_uri(uri);
    try {
        return read_file(path_inside(document.folder, percent_decoded(uri)), document.limits.file_bytes);
    } catch (const Error& error) {
        throw MeshFault(fmt::format("needs {}", error.what()));
    }
}

}  // namespace voxilux
