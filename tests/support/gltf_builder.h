#pragma once

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

// Writes small glTF files in memory, valid or invalid.
namespace gltf_builder {

using nlohmann::json;

inline std::string bytes_of(const void* data, std::size_t size) {
    return {static_cast<const char*>(data), size};
}

template <class T>
std::string bytes_of(const std::vector<T>& values) {
    return bytes_of(values.data(), values.size() * sizeof(T));
}

inline std::string word(std::size_t value) {
    const auto bits = static_cast<std::uint32_t>(value);
    return bytes_of(&bits, sizeof bits);
}

inline std::string base64(const std::string& bytes) {
    const char* const alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? alphabet[bits >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

inline std::string glb_of(const std::string& json_text, const std::string& binary) {
    std::string text = json_text, data = binary;
    text.resize((text.size() + 3) / 4 * 4, ' ');
    data.resize((data.size() + 3) / 4 * 4, '\0');
    const std::string chunks = word(text.size()) + "JSON" + text +
                               (data.empty() ? "" : word(data.size()) + std::string("BIN\0", 4) + data);
    return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
}

// A file with one scene, one node and one mesh, to which parts are added.
struct File {
    json root = {{"asset", {{"version", "2.0"}}}, {"scenes", {{{"nodes", {0}}}}},
                 {"nodes", {{{"mesh", 0}}}},      {"meshes", {{{"primitives", json::array()}}}},
                 {"bufferViews", json::array()},  {"accessors", json::array()}};
    std::string binary;

    // The index of a new view of `bytes`, which start at a multiple of 4.
    int view(const std::string& bytes, int stride = 0) {
        binary.resize((binary.size() + 3) / 4 * 4, '\0');
        json item = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
        if (stride > 0) item["byteStride"] = stride;
        binary += bytes;
        root["bufferViews"].push_back(item);
        return static_cast<int>(root["bufferViews"].size()) - 1;
    }

    // The index of a new accessor; `more` may hold any of its other properties.
    int accessor(int view, int component, const std::string& type, std::size_t count, const json& more = {}) {
        json item = {{"componentType", component}, {"type", type}, {"count", count}};
        if (view >= 0) item["bufferView"] = view;
        if (more.is_object()) item.update(more);
        root["accessors"].push_back(item);
        return static_cast<int>(root["accessors"].size()) - 1;
    }

    int floats(const std::vector<float>& values, int width) {
        static const char* const types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
        return accessor(view(bytes_of(values)), 5126, types[width],
                        values.size() / static_cast<std::size_t>(width));
    }

    json& primitive(const json& attributes, const json& more = {}) {
        json& list = root["meshes"][0]["primitives"];
        list.push_back({{"attributes", attributes}});
        if (more.is_object()) list.back().update(more);
        return list.back();
    }

    // The JSON of the file, with the one buffer that all views read.
    [[nodiscard]] json with_buffer(bool is_embedded) const {
        json result = root;
        if (result.contains("buffers") || binary.empty()) return result;
        json buffer = {{"byteLength", binary.size()}};
        if (is_embedded) buffer["uri"] = "data:application/octet-stream;base64," + base64(binary);
        result["buffers"] = json::array({buffer});
        return result;
    }

    [[nodiscard]] std::string glb() const { return glb_of(with_buffer(false).dump(), binary); }
    [[nodiscard]] std::string gltf() const { return with_buffer(true).dump(); }
};

// Four corners of the unit square in the plane z = 0.
inline const std::vector<float> kSquare = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

// Two indexed triangles on the unit square.
inline File square() {
    File file;
    const int positions = file.floats(kSquare, 3);
    const int indices =
        file.accessor(file.view(bytes_of(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3})), 5123, "SCALAR", 6);
    file.primitive({{"POSITION", positions}}, {{"indices", indices}});
    return file;
}

// A PNG of 2 x 2 texels: red, green, blue, white.
inline std::string small_png() {
    constexpr unsigned char kBytes[] = {
        0x89, 'P', 'N', 'G', 13, 10, 26, 10, 0, 0, 0, 13, 'I', 'H', 'D', 'R', 0, 0, 0, 2, 0, 0, 0, 2, 8, 2, 0,
        0, 0, 0xFD, 0xD4, 0x9A, 0x73, 0, 0, 0, 0x19, 'I', 'D', 'A', 'T', 0x78, 1, 1, 14, 0, 0xF1, 0xFF,
        // stored deflate block of 14 bytes: filter 0, two texels, filter 0, two texels
        0, 255, 0, 0, 0, 255, 0, 0, 0, 0, 255, 255, 255, 255, 0x1F, 0xEE, 5, 0xFB, 0, 0, 0, 0, 0, 0, 0, 0,
        'I', 'E', 'N', 'D', 0xAE, 0x42, 0x60, 0x82};
    return bytes_of(kBytes, sizeof kBytes);
}

// The square with texture coordinates and a material that reads small_png() from a view.
inline File textured_square() {
    File file = square();
    const int uv = file.floats({0, 0, 1, 0, 1, 1, 0, 1}, 2);
    json& primitive = file.root["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_0"] = uv;
    primitive["material"] = 0;
    file.root["images"] = {{{"bufferView", file.view(small_png())}, {"mimeType", "image/png"}}};
    file.root["textures"] = {{{"source", 0}}};
    file.root["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0}}}}};
    return file;
}

}  // namespace gltf_builder
