#pragma once

// .stl, .ply and .xyz files written value by value from the published formats, without the engine's readers.

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <random>
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

}  // namespace mesh_file_builder
