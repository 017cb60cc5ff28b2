#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Writes .vox files byte by byte from the published format, without the engine's writer, and lets a test lie
// in any field. A chunk is a string of bytes.
namespace vox_builder {

using Pairs = std::vector<std::pair<std::string, std::string>>;

inline std::string u32(std::uint32_t v) {
    std::string out;
    for (int shift = 0; shift < 32; shift += 8)
        out += static_cast<char>(v >> shift & 0xFF);
    return out;
}

inline std::string i32(int v) {
    return u32(static_cast<std::uint32_t>(v));
}

inline std::string f32(float v) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &v, sizeof bits);
    return u32(bits);
}

inline std::string size_of(std::size_t n) {
    return u32(static_cast<std::uint32_t>(n));
}

inline std::string text(std::string_view s) {
    return size_of(s.size()) + std::string(s);
}

inline std::string dict(const Pairs& pairs) {
    std::string out = size_of(pairs.size());
    for (const auto& [key, value] : pairs)
        out += text(key) + text(value);
    return out;
}

inline std::string chunk(std::string_view id, std::string_view content, std::string_view children = "") {
    return std::string(id) + size_of(content.size()) + size_of(children.size()) + std::string(content) +
           std::string(children);
}

inline std::string size_chunk(int x, int y, int z) {
    return chunk("SIZE", i32(x) + i32(y) + i32(z));
}

struct Cell {
    int x, y, z, index;
};

inline std::string voxels_chunk(const std::vector<Cell>& cells) {
    std::string out = size_of(cells.size());
    for (const Cell& c : cells) {
        for (const int v : {c.x, c.y, c.z, c.index})
            out += static_cast<char>(v);
    }
    return chunk("XYZI", out);
}

inline std::string transform(int id, int child, int layer, const std::vector<Pairs>& frames,
                             const Pairs& attributes = {}) {
    std::string out = i32(id) + dict(attributes) + i32(child) + i32(-1) + i32(layer) + size_of(frames.size());
    for (const Pairs& frame : frames)
        out += dict(frame);
    return chunk("nTRN", out);
}

inline std::string group(int id, const std::vector<int>& children, const Pairs& attributes = {}) {
    std::string out = i32(id) + dict(attributes) + size_of(children.size());
    for (const int child : children)
        out += i32(child);
    return chunk("nGRP", out);
}

inline std::string shape(int id, const std::vector<std::pair<int, Pairs>>& models,
                         const Pairs& attributes = {}) {
    std::string out = i32(id) + dict(attributes) + size_of(models.size());
    for (const auto& [model, frame] : models)
        out += i32(model) + dict(frame);
    return chunk("nSHP", out);
}

inline std::string layer(int id, const Pairs& attributes) {
    return chunk("LAYR", i32(id) + dict(attributes) + i32(-1));
}

inline std::string record(std::string_view chunk_id, int id, const Pairs& attributes) {
    return chunk(chunk_id, i32(id) + dict(attributes));
}

inline std::string palette_chunk() {
    std::string out;
    for (int i = 0; i < 256; ++i) {
        for (const int v : {i, 255 - i, i * 7 % 256, 255})
            out += static_cast<char>(v);
    }
    return chunk("RGBA", out);
}

inline std::vector<std::byte> bytes_of(std::string_view s) {
    std::vector<std::byte> out(s.size());
    if (!s.empty()) std::memcpy(out.data(), s.data(), s.size());
    return out;
}

inline std::string file_text(std::string_view chunks, int version = 150) {
    return "VOX " + i32(version) + chunk("MAIN", "", chunks);
}

inline std::vector<std::byte> file(std::string_view chunks, int version = 150) {
    return bytes_of(file_text(chunks, version));
}

// A model with no symmetry: no rotation or mirror of it is itself.
inline std::string chiral_model(int x, int y, int z) {
    return size_chunk(x, y, z) +
           voxels_chunk({{0, 0, 0, 1}, {x - 1, 0, 0, 2}, {0, y - 1, 0, 3}, {0, 0, z - 1, 4}, {1, 1, 0, 5}});
}

// A small file with every chunk and attribute that the reader knows, and two that it does not.
inline std::string rich_file_text() {
    std::string c = chiral_model(3, 4, 5) + size_chunk(2, 2, 2) +
                    voxels_chunk({{0, 0, 0, 1}, {1, 1, 1, 255}, {1, 1, 1, 7}});
    c += transform(0, 1, -1, {{}});
    c += group(1, {2, 4, 6});
    c += transform(2, 3, 0, {{{"_f", "0"}, {"_t", "5 -6 7"}}, {{"_f", "10"}, {"_r", "40"}, {"_t", "1 2 3"}}},
                   {{"_name", "first"}, {"_loop", "1"}});
    c += shape(3, {{0, {{"_f", "0"}}}, {1, {{"_f", "4"}}}}, {{"_loop", "1"}});
    c += transform(4, 5, 1, {{{"_r", "17"}, {"_t", "-3 0 4"}}}, {{"_name", "second"}, {"_hidden", "0"}});
    c += shape(5, {{1, {}}});
    c += transform(6, 5, 2, {{{"_t", "0 0 9"}}}, {{"_hidden", "1"}});
    c += layer(0, {{"_name", "ground"}, {"_color", "255 204 153"}}) + layer(1, {{"_hidden", "1"}}) +
         layer(2, {});
    std::string imap;
    for (int i = 0; i < 256; ++i)
        imap += static_cast<char>(255 - i);
    c += palette_chunk() + chunk("IMAP", imap);
    c += record("MATL", 1,
                {{"_type", "_metal"},
                 {"_metal", "0.75"},
                 {"_rough", "0.25"},
                 {"_ior", "0.3"},
                 {"_ri", "1.3"},
                 {"_spec", "0.5"},
                 {"_sp", "1"}});
    c += record("MATL", 2,
                {{"_type", "_glass"}, {"_alpha", "0.5"}, {"_ior", "0.5"}, {"_att", "0.1"}, {"_d", "0.05"}});
    c += record("MATL", 3, {{"_type", "_emit"}, {"_emit", "0.5"}, {"_flux", "3"}, {"_ldr", "0.62"}});
    c += record("MATL", 4, {{"_type", "_blend"}, {"_metal", "0.1"}, {"_trans", "0.2"}});
    c +=
        record("MATL", 5,
               {{"_type", "_media"}, {"_media_type", "_sss"}, {"_media", "1"}, {"_g", "0.4"}, {"_d", "0.1"}});
    c += record("MATL", 7, {{"_rough", "0.1"}});
    c += chunk("MATT", i32(6) + i32(3) + f32(0.5f) + u32(0x22) + f32(0.25f) + f32(0.5f));
    c += record("rCAM", 0,
                {{"_mode", "pers"},
                 {"_focus", "0 0 0"},
                 {"_angle", "0 0 0"},
                 {"_radius", "0"},
                 {"_frustum", "0.414214"},
                 {"_fov", "45"}});
    c += chunk("rOBJ", dict({{"_type", "_inf"}, {"_angle", "50 50"}, {"_i", "0.7"}}));
    c += chunk("NOTE", size_of(2) + text("rock") + text(""));
    c += chunk("META", dict({{"_anim_range", "0 30"}}));
    c += chunk("rLIT", "whatever", chunk("rSUB", "x")) + chunk("rDIS", "");
    return file_text(c, 200);
}

}  // namespace vox_builder
