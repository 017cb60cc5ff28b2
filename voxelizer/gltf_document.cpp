#include "voxelizer/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>

#include "base/error.h"
#include "base/file.h"
#include "base/printable.h"
#include "voxelizer/gltf_form.h"
#include "voxelizer/gltf_json.h"
#include "voxelizer/mesh_features.h"
#include "voxelizer/mesh_uri.h"

namespace voxilux {
namespace {

using nlohmann::json;
using Bytes = std::span<const std::byte>;

constexpr std::uint32_t kMagic = 0x46546C67;        // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;  // "BIN"
constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;

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
    const JsonItem asset = child(root, "asset");
    const std::string version = has(asset, "version") ? read_text(asset, "version") : "";
    if (version.starts_with("2.")) return;
    if (version.empty()) throw MeshFault("asset.version is missing: glTF 2.0 is read");
    throw MeshFault(fmt::format("glTF {} is not read: export the mesh as glTF 2.0", quoted_name(version)));
}

void check_required_extensions(const JsonItem& root) {
    if (!has(root, "extensionsRequired")) return;
    for (const std::string& name : read_texts(root, "extensionsRequired")) {
        const MeshFeature* feature = find_feature(FeatureKind::gltf_extension, name);
        if (feature == nullptr || feature->fate == FeatureFate::fallback)
            throw MeshFault(fmt::format(
                "needs the extension {}, which is not read: export the mesh without it", quoted_name(name)));
    }
}

// How many objects of a document use each extension; one that only the document itself uses counts once.
// Iterative: a file may be nested as deep as it is long.
std::map<std::string, std::size_t> extension_uses(const json& document) {
    std::map<std::string, std::size_t> uses;
    std::vector<const json*> open = {&document};
    while (!open.empty()) {
        const json& item = *open.back();
        open.pop_back();
        for (const auto& [key, value] : item.items()) {
            if (!value.is_structured() || key == "extras") continue;
            open.push_back(&value);
            if (key != "extensions" || !value.is_object()) continue;
            for (const auto& [name, extension] : value.items())
                uses[name] += &item == &document ? 0 : 1;
        }
    }
    for (auto& [name, count] : uses)
        count = std::max<std::size_t>(count, 1);
    return uses;
}

bool moves_nodes(const json& animation) {
    if (!animation.is_object() || !animation.contains("channels")) return false;
    return std::ranges::any_of(animation["channels"], [](const json& channel) {
        const json path = channel.is_object() ? channel.value("/target/path"_json_pointer, json()) : json();
        return path.is_string() && path != "weights";  // those of morph targets are noted at the mesh
    });
}

// Notes what the document contains that is not read, or not exactly.
void note_features(const json& document, MeshNotes& notes) {
    for (const auto& [name, uses] : extension_uses(document))
        note_feature(FeatureKind::gltf_extension, name, notes, uses);
    const auto animations = document.find("animations");
    if (animations == document.end() || !animations->is_array()) return;
    if (const auto moving = std::ranges::count_if(*animations, moves_nodes); moving > 0)
        notes["an animation is ignored: the mesh is read in its rest pose"] +=
            static_cast<std::size_t>(moving);
}

// The form of the document, after checking that it is of a kind that is read.
json checked_form(Bytes text, MeshNotes& notes) {
    const json document = parse_json(text);
    if (!document.is_object()) throw MeshFault("the JSON is not an object");
    check_version({&document, ""});
    check_required_extensions({&document, ""});
    note_features(document, notes);
    return gltf_form(document);
}

const json& list_of(const json& form, const char* key) {
    static const json kNone = json::array();
    const auto found = form.find(key);
    return found == form.end() ? kNone : *found;
}

// tinygltf refuses indices without a view, but does not say why there is none.
void check_index_views(const json& form) {
    const json& accessors = list_of(form, "accessors");
    for (const json& mesh : list_of(form, "meshes")) {
        for (const json& primitive : list_of(mesh, "primitives")) {
            const int index = primitive.value("indices", -1);
            if (index < 0 || static_cast<std::size_t>(index) >= accessors.size()) continue;
            if (accessors[static_cast<std::size_t>(index)].contains("bufferView")) continue;
            const bool is_draco = primitive.contains("/extensions/KHR_draco_mesh_compression"_json_pointer);
            throw MeshFault(
                fmt::format("accessors[{}] holds indices, but has no bufferView{}", index,
                            is_draco ? " but that of KHR_draco_mesh_compression, which is not read" : ""));
        }
    }
}

// tinygltf takes the range of an image in its buffer without checking the size of either.
void check_image_views(const json& form) {
    const json &images = list_of(form, "images"), &views = list_of(form, "bufferViews"),
               &buffers = list_of(form, "buffers");
    for (std::size_t i = 0; i < images.size(); ++i) {
        const auto view = checked_index(images[i].value("bufferView", -1), views.size(),
                                        fmt::format("images[{}].bufferView", i), "bufferViews");
        if (!view) continue;
        const auto buffer = checked_index(views[*view]["buffer"], buffers.size(),
                                          fmt::format("bufferViews[{}].buffer", *view), "buffers");
        const std::uint64_t size = buffers[buffer.value()]["byteLength"];
        const std::uint64_t offset = views[*view].value("byteOffset", std::uint64_t{0});
        const std::uint64_t length = views[*view]["byteLength"];
        if (length == 0)
            throw MeshFault(fmt::format("bufferViews[{}], which images[{}] reads, is empty", *view, i));
        if (offset > size || length > size - offset)
            throw MeshFault(fmt::format("bufferViews[{}] reaches byte {} of a buffer of {}", *view,
                                        offset + length, size));
    }
}

// Removes the strides, keyed by view, because tinygltf would refuse the whole file for some of them: some
// writers use values other than multiples of 4 up to 252. They are checked against their elements when those
// are read.
std::map<std::size_t, std::uint64_t> take_strides(json& form) {
    std::map<std::size_t, std::uint64_t> strides;
    for (std::size_t i = 0; i < list_of(form, "bufferViews").size(); ++i) {
        json& view = form["bufferViews"][i];
        const std::uint64_t stride = view.value("byteStride", std::uint64_t{0});
        if (stride <= 252 && stride % 4 == 0) continue;
        strides[i] = stride;
        view.erase("byteStride");
    }
    return strides;
}

// tinygltf refuses a file for a camera that lacks fields that are not read here. A camera that is not
// perspective becomes one without an angle.
void complete_cameras(json& form) {
    if (!form.contains("cameras")) return;
    for (json& camera : form["cameras"]) {
        const double angle = camera.value("/perspective/yfov"_json_pointer, 0.0);
        camera["type"] = "perspective";
        camera["perspective"] = {{"yfov", angle}, {"znear", 1.0}};
    }
}

// Removes the URIs of a list and replaces each by the index of its item. Only the index is passed to
// tinygltf: its URI decoding reads a + as a space, and accepts broken base64.
std::vector<std::optional<std::string>> take_uris(json& form, const char* key) {
    std::vector<std::optional<std::string>> uris;
    if (!form.contains(key)) return uris;
    for (json& item : form[key]) {
        std::optional<std::string>& uri = uris.emplace_back();
        if (item.contains("uri")) uri = std::move(item["uri"].get_ref<std::string&>());
        item["uri"] = std::to_string(uris.size() - 1);
    }
    return uris;
}

// Images have a uri or a bufferView, or neither: those remain without an image.
std::vector<std::optional<std::string>> take_image_uris(json& form) {
    auto uris = take_uris(form, "images");
    for (std::size_t i = 0; i < uris.size(); ++i) {
        json& image = form["images"][i];
        if (uris[i] && !uris[i]->empty())
            image.erase("bufferView");
        else if (image.contains("bufferView"))
            image.erase("uri");
    }
    return uris;
}

// The sources of a buffer.
struct BufferSources {
    std::vector<std::optional<std::string>> uris;
    std::vector<std::uint64_t> lengths;
    std::optional<Bytes> binary;  // the BIN chunk of a .glb file
};

BufferSources take_buffers(json& form, const MeshLimits& limits) {
    BufferSources sources{.uris = take_uris(form, "buffers"), .lengths = {}, .binary = {}};
    std::uint64_t left = limits.file_bytes;
    for (std::size_t i = 0; i < sources.uris.size(); ++i) {
        const std::uint64_t length = form["buffers"][i]["byteLength"];
        if (length == 0) throw MeshFault(fmt::format("buffers[{}].byteLength is 0", i));
        if (length > left) throw MeshFault(fmt::format("the buffers have over {} bytes", limits.file_bytes));
        left -= length;
        sources.lengths.push_back(length);
    }
    return sources;
}

std::vector<unsigned char> cut_to(Bytes bytes, std::size_t index, std::uint64_t length) {
    if (bytes.size() < length)
        throw MeshFault(
            fmt::format("buffers[{}] should have {} bytes, but has {}", index, length, bytes.size()));
    const auto* first = reinterpret_cast<const unsigned char*>(bytes.data());
    return {first, first + length};
}

std::vector<unsigned char> buffer_bytes(const GltfDocument& document, const BufferSources& sources,
                                        std::size_t index) {
    const auto& uri = sources.uris.at(index);
    const std::uint64_t length = sources.lengths.at(index);
    if (uri) return cut_to(uri_bytes(document, *uri), index, length);
    if (index != 0 || !sources.binary)
        throw MeshFault(fmt::format("buffers[{}] has neither a uri nor a GLB chunk", index));
    return cut_to(*sources.binary, index, length);
}

}  // namespace

GltfDocument parse_gltf(Bytes bytes, const std::filesystem::path& folder, const MeshLimits& limits,
                        MeshNotes& notes) {
    GltfDocument document{.folder = folder, .limits = limits, .model = {}};
    GlbChunks chunks{.json = bytes, .binary = {}};
    if (bytes.size() >= 4 && word_at(bytes, 0) == kMagic) chunks = split_glb(bytes);
    json form = checked_form(chunks.json, notes);
    check_index_views(form);
    complete_cameras(form);
    const auto strides = take_strides(form);
    auto image_uris = take_image_uris(form);
    BufferSources sources = take_buffers(form, limits);
    check_image_views(form);
    sources.binary = chunks.binary;
    document.model = parse_model(std::move(form),
                                 [&](std::size_t index) { return buffer_bytes(document, sources, index); });
    for (std::size_t i = 0; i < document.model.images.size(); ++i)
        document.model.images[i].uri = std::move(image_uris.at(i)).value_or("");
    for (const auto& [view, stride] : strides)
        document.model.bufferViews.at(view).byteStride = stride;
    return document;
}

Bytes view_bytes(const GltfDocument& document, std::size_t index) {
    const tinygltf::BufferView& view = document.model.bufferViews.at(index);
    const auto buffer = checked_index(view.buffer, document.model.buffers.size(),
                                      fmt::format("bufferViews[{}].buffer", index), "buffers");
    if (!buffer) throw MeshFault(fmt::format("bufferViews[{}].buffer is missing", index));
    const Bytes bytes = std::as_bytes(std::span(document.model.buffers[*buffer].data));
    const std::uint64_t offset = view.byteOffset, length = view.byteLength;
    if (offset > bytes.size() || length > bytes.size() - offset)
        throw MeshFault(fmt::format("bufferViews[{}] reaches byte {} of a buffer of {}", index,
                                    offset + length, bytes.size()));
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
