#pragma once

// .stl, .ply, .xyz and .las files written value by value from the published formats, without the engine's
// readers.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/glm.hpp>

#include "support/vox_builder.h"

namespace mesh_file_builder {

// Positions are floats, so that text and binary say the same; a colour belongs to each.
struct PlainMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::u8vec3> colours;
    std::vector<glm::uvec3> triangles;
};

inline PlainMesh random_mesh(std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto number = [&] { return static_cast<float>(random() % 2000) / 16.0f - 50.0f; };
    PlainMesh mesh;
    for (std::uint32_t i = 0; i < 4 + seed; ++i) {
        mesh.positions.emplace_back(number(), number(), number());
        mesh.colours.emplace_back(random() % 256, random() % 256, random() % 256);
    }
    const auto vertex = [&] { return random() % static_cast<std::uint32_t>(mesh.positions.size()); };
    for (std::uint32_t i = 0; i < 3 + seed; ++i)
        mesh.triangles.emplace_back(vertex(), vertex(), vertex());
    return mesh;
}

inline std::string stl_binary(const PlainMesh& mesh) {
    std::string out = "solid " + std::string(74, '.') + vox_builder::size_of(mesh.triangles.size());
    for (const glm::uvec3 triangle : mesh.triangles) {
        out += std::string(12, '\0');
        for (int c = 0; c < 3; ++c)
            for (int axis = 0; axis < 3; ++axis)
                out += vox_builder::f32(mesh.positions[triangle[c]][axis]);
        out += std::string(2, '\0');
    }
    return out;
}

inline std::string stl_text(const PlainMesh& mesh) {
    std::string out = "solid a name\n";
    for (const glm::uvec3 triangle : mesh.triangles) {
        out += " facet normal 0 0 0\n  outer loop\n";
        for (int c = 0; c < 3; ++c) {
            const glm::vec3 p = mesh.positions[triangle[c]];
            out += fmt::format("   vertex {:e} {} {}\n", p.x, p.y, p.z);
        }
        out += "  endloop\n endfacet\n";
    }
    return out + "endsolid a name\n";
}

enum class PlyWriting { text, little_endian, big_endian };

// Appends values of either kind of file.
class PlyWriter {
  public:
    explicit PlyWriter(PlyWriting writing) : writing_(writing) {}

    template <class T>
    void add(T value) {
        if (writing_ == PlyWriting::text) {
            text_ += fmt::format("{} ", +value);
            return;
        }
        char bytes[sizeof(T)];
        std::memcpy(bytes, &value, sizeof(T));
        if (writing_ == PlyWriting::big_endian) std::reverse(std::begin(bytes), std::end(bytes));
        text_.append(bytes, sizeof(T));
    }
    void end_line() {
        if (writing_ == PlyWriting::text) text_ += '\n';
    }
    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    PlyWriting writing_;
    std::string text_;
};

inline std::string ply(const PlainMesh& mesh, PlyWriting writing) {
    constexpr const char* kNames[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    std::string head = fmt::format("ply\nformat {} 1.0\ncomment made by a test\nelement vertex {}\n",
                                   kNames[static_cast<int>(writing)], mesh.positions.size());
    head +=
        "property double x\nproperty float32 y\nproperty float z\nproperty list uchar short more\n"
        "property uchar red\nproperty uint8 green\nproperty ushort blue\n";
    head += fmt::format("element camera 1\nproperty int a\nelement face {}\n", mesh.triangles.size());
    head += "property float quality\nproperty list uchar int vertex_indices\nend_header\n";
    PlyWriter out(writing);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        out.add(static_cast<double>(mesh.positions[i].x));
        out.add(mesh.positions[i].y);
        out.add(mesh.positions[i].z);
        out.add(static_cast<std::uint8_t>(1));
        out.add(static_cast<std::int16_t>(-7));
        out.add(mesh.colours[i].r);
        out.add(mesh.colours[i].g);
        out.add(static_cast<std::uint16_t>(mesh.colours[i].b * 257));
        out.end_line();
    }
    out.add(-5);
    out.end_line();
    for (const glm::uvec3 triangle : mesh.triangles) {
        out.add(0.5f);
        out.add(static_cast<std::uint8_t>(3));
        for (int c = 0; c < 3; ++c)
            out.add(static_cast<std::int32_t>(triangle[c]));
        out.end_line();
    }
    return head + out.text();
}

inline std::string ply_points(const PlainMesh& mesh, PlyWriting writing) {
    return ply({mesh.positions, mesh.colours, {}}, writing);
}

inline std::string xyz(const PlainMesh& mesh) {
    std::string out = fmt::format("{}\n# x y z r g b\n", mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 p = mesh.positions[i];
        const glm::u8vec3 c = mesh.colours[i];
        out += fmt::format("{} {}\t{}  {} {} {}\r\n", p.x, p.y, p.z, +c.r, +c.g, +c.b);
    }
    return out;
}

// Bytes of a little-endian value.
template <class T>
std::string le(T value) {
    return {reinterpret_cast<const char*>(&value), sizeof(value)};
}

// The steps of coordinates in a .las file: powers of two, so that the places of random_mesh are exact.
inline constexpr double kLasScale = 1.0 / 1024, kLasOffset = 500000.0;

inline bool las_has_colours(int format) {
    return std::set<int>{2, 3, 5, 7, 8, 10}.contains(format);
}

// A .las file of version 1.0 (10) to 1.4 (14). Formats 2, 3, 5, 7, 8 and 10 have colours, of 16 bits from 1.2
// on.
inline std::string las(const PlainMesh& mesh, int format, int version) {
    const std::map<int, std::size_t> bytes = {{0, 20}, {1, 28}, {2, 26}, {3, 34}, {4, 57}, {5, 63},
                                              {6, 30}, {7, 36}, {8, 38}, {9, 59}, {10, 67}};
    const std::map<int, std::size_t> colours = {{2, 20}, {3, 28}, {5, 28}, {7, 30}, {8, 30}, {10, 30}};
    const std::size_t stride = bytes.at(format) + 3, head_bytes = version == 14 ? 375 : 227;
    const auto count = static_cast<std::uint32_t>(mesh.positions.size());
    std::string head(head_bytes, '\0'), points;
    const auto put = [](std::string& text, std::size_t at, const std::string& value) {
        text.replace(at, value.size(), value);
    };
    put(head, 0, "LASF");
    put(head, 24, std::string{static_cast<char>(version / 10), static_cast<char>(version % 10)});
    put(head, 94, le(static_cast<std::uint16_t>(head_bytes)));
    put(head, 96, le(static_cast<std::uint32_t>(head_bytes + 5)));
    put(head, 104, std::string{static_cast<char>(format)} + le(static_cast<std::uint16_t>(stride)));
    put(head, 107, le(version == 14 ? 0u : count));
    if (version == 14) put(head, 247, le(std::uint64_t{count}));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        put(head, 131 + 8 * axis, le(kLasScale));
        put(head, 155 + 8 * axis, le(kLasOffset));
    }
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        std::string point(stride, '\x55');
        for (int axis = 0; axis < 3; ++axis) {
            const auto n = static_cast<std::size_t>(axis);
            put(point, 4 * n,
                le(static_cast<std::int32_t>(std::lround(mesh.positions[i][axis] / kLasScale))));
            const unsigned code = mesh.colours[i][axis] * (version >= 12 ? 257u : 1u);
            if (las_has_colours(format))
                put(point, colours.at(format) + 2 * n, le(static_cast<std::uint16_t>(code)));
        }
        points += point;
    }
    return head + "extra" + points;
}

}  // namespace mesh_file_builder
