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

struct SampledFormat {
    const char* ending;
    Sample (*make)(std::uint32_t seed);
};
inline constexpr SampledFormat kSampledFormats[] = {
    {".qb", qb_sample}, {".kv6", kv6_sample}, {".vxl", vxl_sample}, {".binvox", binvox_sample}};

}  // namespace voxel_file_builder
