#pragma once

// Files of other voxel programs, written byte by byte from the published formats, without the engine's
// readers: from cells in the file's own axes, and with the cells that a .vox file should hold.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include <glm/glm.hpp>

#include "formats/voxel_cells.h"
#include "support/vox_builder.h"

namespace voxel_file_builder {

using vox_builder::f32;
using vox_builder::i32;
using vox_builder::u32;

// By place, z slowest.
struct Before {
    bool operator()(glm::ivec3 a, glm::ivec3 b) const {
        return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
    }
};
using Cells = std::map<glm::ivec3, glm::u8vec3, Before>;

struct Sample {
    std::string bytes;
    Cells expected;  // in the space of .vox files
};

inline std::string u16(unsigned v) {
    return {static_cast<char>(v & 0xFF), static_cast<char>(v >> 8)};
}

inline std::string bgra(glm::u8vec3 c, std::uint8_t alpha = 128) {
    return {static_cast<char>(c.b), static_cast<char>(c.g), static_cast<char>(c.r), static_cast<char>(alpha)};
}

inline std::string rgba(glm::u8vec3 c) {
    return bgra({c.b, c.g, c.r}, 255);
}

// Cells of a box with a share of 1/2 filled, in runs; the colours tell the cells apart.
inline Cells random_cells(glm::ivec3 size, std::uint32_t seed) {
    std::mt19937 random(seed);
    Cells cells;
    glm::u8vec3 colour(1);
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                if (random() % 2 == 0) colour = {random() % 256, random() % 256, random() % 256};
                if (random() % 2 == 0) cells[{x, y, z}] = colour;
            }
    cells[{0, 0, 0}] = {9, 8, 7};
    return cells;
}

inline Cells moved(const Cells& cells, const std::function<glm::ivec3(glm::ivec3)>& move) {
    Cells result;
    for (const auto& [at, colour] : cells)
        result[move(at)] = colour;
    return result;
}

// One matrix of a .qb file, y up.
inline std::string qb_matrix(const Cells& cells, glm::ivec3 size, glm::ivec3 low, bool is_bgra,
                             bool is_compressed) {
    std::string out =
        "\x04name" + i32(size.x) + i32(size.y) + i32(size.z) + i32(low.x) + i32(low.y) + i32(low.z);
    const auto word = [&](glm::ivec3 at) {
        const auto found = cells.find(at);
        if (found == cells.end()) return u32(0x00123456);  // an alpha of 0 is empty, whatever its colour
        return is_bgra ? bgra(found->second, 255) : rgba(found->second);
    };
    for (int z = 0; z < size.z; ++z) {
        for (int i = 0; i < size.x * size.y;) {
            const std::string one = word({i % size.x, i / size.x, z});
            int count = 1;
            while (is_compressed && i + count < size.x * size.y &&
                   word({(i + count) % size.x, (i + count) / size.x, z}) == one)
                ++count;
            out += count > 1 ? u32(2) + i32(count) + one : one;
            i += count;
        }
        if (is_compressed) out += u32(6);
    }
    return out;
}

inline std::string qb_header(bool is_bgra, bool is_right_handed, bool is_compressed, int matrices) {
    return u32(0x101) + i32(is_bgra) + i32(is_right_handed) + i32(is_compressed) + i32(0) + i32(matrices);
}

inline Sample qb_sample(std::uint32_t seed) {
    const glm::ivec3 size(1 + seed % 5, 2 + seed % 7, 3 + seed % 4), low(-3, 7, static_cast<int>(seed) - 5);
    const bool is_bgra = (seed & 1) != 0, is_right_handed = (seed & 2) != 0, is_compressed = (seed & 4) != 0;
    const Cells cells = random_cells(size, seed);
    Sample sample{qb_header(is_bgra, is_right_handed, is_compressed, 2), {}};
    const glm::ivec3 second = low + glm::ivec3(20, 0, 1);
    for (const glm::ivec3 corner : {low, second}) {
        sample.bytes += qb_matrix(cells, size, corner, is_bgra, is_compressed);
        sample.expected.merge(moved(cells, [&](glm::ivec3 c) {
            const glm::ivec3 at = c + corner;
            return is_right_handed ? glm::ivec3(at.x, -1 - at.z, at.y) : glm::ivec3(at.x, at.z, at.y);
        }));
    }
    return sample;
}

inline Sample kv6_sample(std::uint32_t seed) {
    const glm::ivec3 size(2 + seed % 5, 1 + seed % 7, 3 + seed % 9), pivot(1, 2, static_cast<int>(seed % 3));
    const Cells cells = random_cells(size, seed);
    std::string voxels, rows, columns;
    for (int x = 0; x < size.x; ++x) {
        const std::size_t row = voxels.size();
        for (int y = 0; y < size.y; ++y) {
            const std::size_t column = voxels.size();
            for (int z = 0; z < size.z; ++z) {
                const auto found = cells.find({x, y, z});
                if (found != cells.end())
                    voxels += bgra(found->second) + u16(static_cast<unsigned>(z)) + "\x3f\x05";
            }
            columns += u16(static_cast<unsigned>((voxels.size() - column) / 8));
        }
        rows += vox_builder::size_of((voxels.size() - row) / 8);
    }
    std::string bytes = "Kvxl" + i32(size.x) + i32(size.y) + i32(size.z);
    for (int axis = 0; axis < 3; ++axis)
        bytes += f32(static_cast<float>(pivot[axis]) + 0.25f);
    bytes += vox_builder::size_of(voxels.size() / 8) + voxels + rows + columns;
    if (seed % 2 == 0) bytes += "SPal" + std::string(768, '\x20');
    return {bytes, moved(cells, [&](glm::ivec3 c) {
                const glm::ivec3 at = c - pivot;
                return glm::ivec3(at.x, -1 - at.y, -1 - at.z);
            })};
}

// A column of a .vxl map from the sky down: ' ' air, '#' ground, else a coloured voxel.
inline std::string vxl_column(const std::string& column, const std::function<glm::u8vec3(int)>& colour) {
    const auto coloured = [&](std::size_t z) { return column[z] != ' ' && column[z] != '#'; };
    std::string out;
    std::size_t z = 0, air = 0;
    std::string above;  // colours of the ground's underside, before the air of the next span
    while (true) {
        while (z < column.size() && column[z] == ' ')
            ++z;
        const std::size_t first = z;
        std::string top;
        while (z < column.size() && coloured(z))
            top += bgra(colour(static_cast<int>(z++)));
        const std::size_t last = z;  // exclusive
        while (z < column.size() && column[z] == '#')
            ++z;
        std::string bottom;
        while (z < column.size() && coloured(z))
            bottom += bgra(colour(static_cast<int>(z++)));
        const bool is_end = z == column.size();
        const std::size_t words = is_end ? 0 : 1 + (top.size() + bottom.size()) / 4;
        out += {static_cast<char>(words), static_cast<char>(first), static_cast<char>(last - 1),
                static_cast<char>(air)};
        out += top + bottom;
        if (is_end) return out;
        air = z;
    }
}

inline std::string random_column(std::size_t depth, std::mt19937& random) {
    std::string column;
    const auto add = [&](char c, std::size_t least) { column += std::string(least + random() % 3, c); };
    do {
        add(' ', 1);
        add('c', 1);
        if (random() % 2 == 0) {
            add('#', 1);
            add('b', 1);
        }
    } while (column.size() + 12 < depth && random() % 4 != 0);
    column += " c";
    return column + std::string(depth - column.size(), '#');
}

inline Sample vxl_map(int side, int depth, std::mt19937& random, std::string bytes) {
    Sample sample{std::move(bytes), {}};
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const std::string column = random_column(static_cast<std::size_t>(depth), random);
            const auto colour = [&](int z) { return glm::u8vec3(x, y * 3, z); };
            sample.bytes += vxl_column(column, colour);
            const bool is_side = x == 0 || y == 0 || x == side - 1 || y == side - 1;
            glm::u8vec3 last(0);
            for (int z = 0; z < depth; ++z) {
                const char c = column[static_cast<std::size_t>(z)];
                if (c == ' ' || (c == '#' && !is_side)) continue;
                if (c != '#') last = colour(z);
                sample.expected[{x, side - 1 - y, depth - 1 - z}] = last;
            }
        }
    return sample;
}

inline Sample vxl_sample(std::uint32_t seed) {
    std::mt19937 random(seed);
    const int side = 2 + static_cast<int>(seed % 5);
    const std::string camera(4 * 3 * 8, '\0');
    return vxl_map(side, 256, random, u32(0x09072000) + i32(side) + i32(side) + camera);
}

inline Sample binvox_sample(std::uint32_t seed) {
    const int side = 2 + static_cast<int>(seed % 9);
    const glm::ivec3 size(side, side, seed % 3 == 0 ? side + 2 : side);
    const Cells cells = random_cells(size, seed);
    std::string bytes = "#binvox " + std::to_string(1 + seed % 2) + "\ndim " + std::to_string(size.x) + " " +
                        std::to_string(size.z) + " " + std::to_string(size.y) + "\n";
    if (seed % 2 == 0) bytes += "translate -0.5 1 2.5e-3\nscale 7.25\n";
    bytes += "data\n";
    Sample sample{bytes, {}};
    std::string dense;
    for (int x = 0; x < size.x; ++x)
        for (int z = 0; z < size.z; ++z)
            for (int y = 0; y < size.y; ++y) {
                const bool is_set = cells.contains({x, y, z});
                dense += is_set ? '\1' : '\0';
                if (is_set) sample.expected[{x, size.z - 1 - z, y}] = glm::u8vec3(255);
            }
    for (std::size_t i = 0; i < dense.size();) {
        std::size_t count = 1;
        while (count < 255 && i + count < dense.size() && dense[i + count] == dense[i])
            ++count;
        sample.bytes += {dense[i], static_cast<char>(count)};
        i += count;
    }
    return sample;
}

// ---- files of Minecraft: Named Binary Tag, big endian, in gzip ----

// A tag: type, name, payload. Numbers of types are those of the format.
inline std::string big(std::uint64_t value, int bytes) {
    std::string out;
    for (int i = bytes - 1; i >= 0; --i)
        out += static_cast<char>(value >> (8 * i) & 0xFF);
    return out;
}
inline std::string nbt_text(const std::string& text) {
    return big(text.size(), 2) + text;
}
inline std::string nbt_tag(int type, const std::string& name, const std::string& payload) {
    return static_cast<char>(type) + nbt_text(name) + payload;
}
inline std::string nbt_short(const std::string& name, int value) {
    return nbt_tag(2, name, big(static_cast<std::uint64_t>(value), 2));
}
inline std::string nbt_int(const std::string& name, std::int64_t value) {
    return nbt_tag(3, name, big(static_cast<std::uint64_t>(value), 4));
}
inline std::string nbt_bytes(const std::string& name, const std::string& bytes) {
    return nbt_tag(7, name, big(bytes.size(), 4) + bytes);
}
inline std::string nbt_string(const std::string& name, const std::string& text) {
    return nbt_tag(8, name, nbt_text(text));
}
inline std::string nbt_compound(const std::string& name, const std::string& children) {
    return nbt_tag(10, name, children + '\0');
}
inline std::string nbt_vector(const std::string& name, glm::ivec3 v) {
    return nbt_compound(name, nbt_int("x", v.x) + nbt_int("y", v.y) + nbt_int("z", v.z));
}

inline std::uint32_t crc32_of(const std::string& text) {
    std::uint32_t crc = 0xFFFFFFFF;
    for (const char c : text) {
        crc ^= static_cast<std::uint8_t>(c);
        for (int i = 0; i < 8; ++i)
            crc = crc >> 1 ^ (crc & 1 ? 0xEDB88320 : 0);
    }
    return ~crc;
}

// A gzip file of stored blocks (RFC 1951, 1952), which needs no compressor.
inline std::string gzipped(const std::string& text) {
    std::string out{"\x1f\x8b\x08\0\0\0\0\0\0\xff", 10};
    for (std::size_t at = 0; at == 0 || at < text.size(); at += 60000) {
        const std::string block = text.substr(at, 60000);
        const auto size = static_cast<unsigned>(block.size());
        out += at + block.size() == text.size() ? '\1' : '\0';
        out += u16(size) + u16(~size & 0xFFFF) + block;
    }
    return out + u32(crc32_of(text)) + u32(static_cast<std::uint32_t>(text.size()));
}

// The content of what `gzipped` returned; other text as it is.
inline std::string unpacked(const std::string& file) {
    if (!file.starts_with("\x1f\x8b")) return file;
    std::string text;
    for (std::size_t at = 10; at + 8 < file.size();) {
        const std::size_t size = static_cast<std::uint8_t>(file[at + 1]) +
                                 (std::size_t{static_cast<std::uint8_t>(file[at + 2])} << 8);
        text += file.substr(at + 5, size);
        at += 5 + size;
    }
    return text;
}

// A gzip file of 7 MB that unpacks to over 1 GiB: the head of an array, then a zero and the order to repeat
// the last byte 258 times, over and over (RFC 1951, 3.2.6: length code 285, distance code 0, 13 bits).
inline std::string schem_bomb() {
    constexpr int kRepeats = 4'200'000;
    const std::string head = static_cast<char>(10) + nbt_text("Schematic") + static_cast<char>(7) +
                             nbt_text("x") + big(0x7FFFFFFF, 4);
    std::string out{"\x1f\x8b\x08\0\0\0\0\0\0\xff\0", 11};
    out += u16(static_cast<unsigned>(head.size())) + u16(~static_cast<unsigned>(head.size()) & 0xFFFF) + head;
    std::uint32_t bits = 0;
    int count = 0;
    const auto put = [&](std::uint32_t code, int width) {  // lowest bit first
        bits |= code << count;
        for (count += width; count >= 8; count -= 8, bits >>= 8)
            out += static_cast<char>(bits & 0xFF);
    };
    put(0b011, 3);       // the last block, fixed codes
    put(0b00001100, 8);  // literal 0: 00110000, highest bit first
    for (int i = 0; i < kRepeats; ++i)
        put(0b10100011, 13);  // 285: 11000101, highest bit first; then five zeros
    put(0, 16);
    return out;
}

// Blocks and the colours that they should have.
struct NamedBlock {
    const char* name;
    glm::u8vec3 colour;
};
inline constexpr NamedBlock kBlocksOfFiles[] = {
    {"minecraft:stone", {0x7D, 0x7D, 0x7D}},      {"minecraft:red_wool", {0x9E, 0x26, 0x22}},
    {"minecraft:oak_planks", {0xA2, 0x83, 0x4F}}, {"minecraft:glowstone", {0xAB, 0x83, 0x54}},
    {"minecraft:water", {0x3F, 0x6F, 0xD8}},      {"minecraft:diamond_block", {0x62, 0xED, 0xE4}}};

// A box of blocks, x fastest, then z, then y: the place of each in kBlocksOfFiles, or -1 for air.
struct Blocks {
    glm::ivec3 size{0};
    std::vector<int> of;
};
inline Blocks random_blocks(glm::ivec3 size, std::uint32_t seed) {
    std::mt19937 random(seed);
    Blocks blocks{size, std::vector<int>(static_cast<std::size_t>(size.x * size.y * size.z))};
    for (int& block : blocks.of)
        block = static_cast<int>(random() % 7) - 1;
    blocks.of[0] = 2;
    return blocks;
}
inline Cells cells_of_blocks(const Blocks& blocks, const std::function<glm::ivec3(glm::ivec3)>& place) {
    Cells cells;
    for (int y = 0, i = 0; y < blocks.size.y; ++y)
        for (int z = 0; z < blocks.size.z; ++z)
            for (int x = 0; x < blocks.size.x; ++x, ++i) {
                const int block = blocks.of[static_cast<std::size_t>(i)];
                if (block >= 0)
                    cells[place({x, y, z})] = kBlocksOfFiles[static_cast<std::size_t>(block)].colour;
            }
    return cells;
}

inline std::string varint(std::uint32_t value) {
    std::string out;
    for (; value >= 0x80; value >>= 7)
        out += static_cast<char>((value & 0x7F) | 0x80);
    return out + static_cast<char>(value);
}

// The number of a block in the palette of a .schem file: some take two bytes.
inline std::uint32_t schem_number(int block) {
    return block < 0 ? 0 : static_cast<std::uint32_t>(block) * 100 + 1;
}

// Version 2 for even seeds, 3 for odd ones; the blocks come before or after the palette.
inline Sample schem_sample(std::uint32_t seed) {
    const glm::ivec3 size(1 + seed % 5, 2 + seed % 4, 3 + seed % 3);
    const Blocks blocks = random_blocks(size, seed);
    const bool is_third = seed % 2 == 1, is_late = seed % 4 < 2;
    std::string palette = nbt_int("minecraft:air", 0), data;
    for (int i = 0; i < 6; ++i)
        palette += nbt_int(kBlocksOfFiles[i].name, schem_number(i));
    for (const int block : blocks.of)
        data += varint(schem_number(block));
    const std::string names = nbt_compound("Palette", palette);
    const std::string numbers = nbt_bytes(is_third ? "Data" : "BlockData", data);
    const std::string both = is_late ? names + numbers : numbers + names;
    // Things to be passed over: lists of compounds and of nothing, arrays, numbers of every size.
    const std::string other =
        nbt_tag(9, "BlockEntities",
                std::string(1, 10) + big(2, 4) + nbt_string("Id", "chest") + '\0' +
                    nbt_tag(6, "d", big(7, 8)) + '\0') +
        nbt_tag(9, "Empty", big(0, 1) + big(0, 4)) +
        nbt_tag(11, "Offset", big(3, 4) + std::string(12, '\0')) +
        nbt_tag(12, "Times", big(1, 4) + big(9, 8)) + nbt_tag(1, "b", "x") + nbt_tag(5, "f", big(1, 4)) +
        nbt_compound("Biomes",
                     nbt_compound("Palette", nbt_int("minecraft:plains", 0)) + nbt_bytes("Data", "xyz"));
    std::string body = nbt_int("Version", is_third ? 3 : 2) + other + nbt_short("Width", size.x) +
                       (is_third ? nbt_compound("Blocks", both) : both) + nbt_short("Height", size.y) +
                       nbt_short("Length", size.z);
    body = nbt_compound(is_third ? "" : "Schematic", is_third ? nbt_compound("Schematic", body) : body);
    return {seed % 5 == 4 ? body : gzipped(body),
            cells_of_blocks(blocks, [&](glm::ivec3 c) { return glm::ivec3(c.x, size.z - 1 - c.z, c.y); })};
}

// A region of a .litematic file; negative sides reach towards lower coordinates.
inline std::string litematic_region(const Blocks& blocks, glm::ivec3 place, glm::ivec3 size,
                                    int more_states) {
    std::string palette = nbt_string("Name", "minecraft:air") + '\0';
    for (const NamedBlock& block : kBlocksOfFiles)
        palette +=
            nbt_compound("Properties", nbt_string("lit", "true")) + nbt_string("Name", block.name) + '\0';
    for (int i = 0; i < more_states; ++i)  // never used: they make the numbers longer
        palette += nbt_string("Name", "minecraft:dirt") + '\0';
    const int states = 7 + more_states;
    int bits = 2;
    while (1 << bits < states)
        ++bits;
    std::vector<bool> stream;
    for (const int block : blocks.of)
        for (int bit = 0; bit < bits; ++bit)
            stream.push_back(((block + 1) >> bit & 1) != 0);
    stream.resize((stream.size() + 63) / 64 * 64);
    std::string words;
    for (std::size_t at = 0; at < stream.size(); at += 64) {
        std::uint64_t word = 0;
        for (std::size_t bit = 0; bit < 64; ++bit)
            word |= std::uint64_t{stream[at + bit]} << bit;
        words += big(word, 8);
    }
    return nbt_tag(12, "BlockStates", big(stream.size() / 64, 4) + words) + nbt_vector("Position", place) +
           nbt_vector("Size", size) +
           nbt_tag(9, "BlockStatePalette",
                   std::string(1, 10) + big(static_cast<std::uint64_t>(states), 4) + palette);
}

// Two regions, the second with negative sides and longer numbers.
inline Sample litematic_sample(std::uint32_t seed) {
    const glm::ivec3 size(2 + seed % 4, 1 + seed % 3, 3 + seed % 5), far(40, 2, -9);
    const Blocks first = random_blocks(size, seed), second = random_blocks(size, seed + 100);
    const glm::ivec3 place(static_cast<int>(seed) - 4, 1, 7);
    const std::string regions =
        nbt_compound("a", litematic_region(first, place, size, 0)) +
        nbt_compound("b", litematic_region(second, far, -size, static_cast<int>(seed) * 9));
    const std::string body =
        nbt_compound("", nbt_int("Version", 6) + nbt_compound("Metadata", nbt_string("Name", "test")) +
                             nbt_compound("Regions", regions));
    Sample sample{gzipped(body), cells_of_blocks(first, [&](glm::ivec3 c) {
                      const glm::ivec3 at = c + place;
                      return glm::ivec3(at.x, -1 - at.z, at.y);
                  })};
    sample.expected.merge(cells_of_blocks(second, [&](glm::ivec3 c) {
        const glm::ivec3 at = c + far - size + 1;
        return glm::ivec3(at.x, -1 - at.z, at.y);
    }));
    return sample;
}

struct SampledFormat {
    const char* ending;
    Sample (*make)(std::uint32_t seed);
};
inline constexpr SampledFormat kSampledFormats[] = {
    {".qb", qb_sample},         {".kv6", kv6_sample},     {".vxl", vxl_sample},
    {".binvox", binvox_sample}, {".schem", schem_sample}, {".litematic", litematic_sample}};

}  // namespace voxel_file_builder
