#pragma once

// Small meshes for tests, made by formulas.

#include <array>
#include <cmath>
#include <vector>

#include "voxelizer/mesh.h"

namespace voxilux::test {

inline Mesh mesh_of(const std::vector<std::array<glm::dvec3, 3>>& triangles) {
    Mesh mesh;
    mesh.materials.emplace_back();
    for (const auto& triangle : triangles) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), triangle.begin(), triangle.end());
        mesh.triangles.push_back({.vertices = {first, first + 1, first + 2}});
    }
    return mesh;
}

// Closed, its normals outwards; vertices are shared.
inline Mesh cube(glm::dvec3 low, glm::dvec3 high) {
    Mesh mesh;
    mesh.materials.emplace_back();
    for (int i = 0; i < 8; ++i)
        mesh.positions.push_back(
            {(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z});
    constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces = {
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (const auto& f : kFaces) {
        mesh.triangles.push_back({.vertices = {f[0], f[1], f[2]}});
        mesh.triangles.push_back({.vertices = {f[0], f[2], f[3]}});
    }
    return mesh;
}

// A torus about a tilted axis: closed, with a hole through it, no face along an axis.
inline Mesh torus(double major, double minor, int around, int across) {
    constexpr double kTurn = 6.283185307179586;
    Mesh mesh;
    mesh.materials.emplace_back();
    const glm::dvec3 x = glm::normalize(glm::dvec3(1.0, 0.3, -0.2));
    const glm::dvec3 z = glm::normalize(glm::cross(x, glm::dvec3(0.1, 1.0, 0.4)));
    const glm::dvec3 y = glm::cross(z, x);
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            const double a = kTurn * i / around;
            const double b = kTurn * j / across;
            const glm::dvec3 outward = x * std::cos(a) + y * std::sin(a);
            mesh.positions.push_back(outward * (major + minor * std::cos(b)) + z * (minor * std::sin(b)));
        }
    }
    const auto at = [&](int i, int j) {
        return static_cast<std::uint32_t>(i % around * across + j % across);
    };
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            mesh.triangles.push_back({.vertices = {at(i, j), at(i + 1, j), at(i + 1, j + 1)}});
            mesh.triangles.push_back({.vertices = {at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
        }
    }
    return mesh;
}

inline void append(Mesh& mesh, const Mesh& other) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    for (const MeshTriangle& triangle : other.triangles)
        mesh.triangles.push_back({.vertices = triangle.vertices + first});
}

}  // namespace voxilux::test
