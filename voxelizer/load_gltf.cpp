#include "voxelizer/load_gltf.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

#include "base/checked_cast.h"
#include "voxelizer/gltf_accessor.h"
#include "voxelizer/gltf_document.h"
#include "voxelizer/gltf_material.h"
#include "voxelizer/gltf_nodes.h"

namespace voxilux {
namespace {

// The accessors of a primitive's vertices. Primitives of one node with equal accessors share their vertices.
using AttributeKey = std::array<std::optional<std::size_t>, 4>;  // POSITION, TEXCOORD_0, TEXCOORD_1, COLOR_0

struct VertexRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

struct Loading {
    GltfDocument document;
    GltfMaterials materials;
    Mesh mesh;
    MeshNotes& notes;
    std::uint64_t parts_read = 0;
    std::uint64_t triangles_read = 0;
};

// A part of a mesh of the file, and its name in messages.
struct Part {
    const tinygltf::Primitive& primitive;
    std::string name;
};

AttributeKey read_attributes(const Loading& loading, const Part& part) {
    const auto index = [&](const char* key) -> std::optional<std::size_t> {
        const auto found = part.primitive.attributes.find(key);
        if (found == part.primitive.attributes.end()) return std::nullopt;
        return checked_index(found->second, loading.document.model.accessors.size(),
                             fmt::format("{}.attributes.{}", part.name, key), "accessors");
    };
    return {index("POSITION"), index("TEXCOORD_0"), index("TEXCOORD_1"), index("COLOR_0")};
}

AccessorValues read_attribute(Loading& loading, std::size_t accessor, std::size_t count,
                              std::size_t min_width) {
    AccessorValues values = read_accessor(loading.document, accessor);
    if (values.count != count)
        throw MeshFault(
            fmt::format("accessors[{}] has {} elements for {} vertices", accessor, values.count, count));
    if (values.width < min_width)
        throw MeshFault(fmt::format("accessors[{}] has elements of {} numbers, not {}", accessor,
                                    values.width, min_width));
    return values;
}

// Appends uv coordinates; earlier vertices without any get zeros.
void append_uv(Loading& loading, std::optional<std::size_t> accessor, const VertexRange& range,
               std::vector<glm::vec2>& uvs) {
    if (!accessor) {
        if (!uvs.empty()) uvs.resize(uvs.size() + range.count);
        return;
    }
    const AccessorValues values = read_attribute(loading, *accessor, range.count, 2);
    uvs.resize(std::size_t{range.first} + range.count);
    for (std::size_t i = 0; i < values.count; ++i) {
        const glm::vec2 uv(values.values[i * values.width], values.values[i * values.width + 1]);
        const bool is_finite = std::isfinite(uv.x) && std::isfinite(uv.y);
        if (!is_finite) ++loading.notes["texture coordinates that are not finite are read as 0"];
        uvs[range.first + i] = is_finite ? uv : glm::vec2(0.0f);
    }
}

void append_colors(Loading& loading, std::optional<std::size_t> accessor, const VertexRange& range) {
    std::vector<glm::vec4>& colors = loading.mesh.colors;
    const glm::vec4 white(1.0f);
    if (!accessor) {
        if (!colors.empty()) colors.resize(colors.size() + range.count, white);
        return;
    }
    const AccessorValues values = read_attribute(loading, *accessor, range.count, 3);
    colors.resize(std::size_t{range.first} + range.count, white);
    for (std::size_t i = 0; i < values.count; ++i) {
        glm::vec4 color = white;
        for (std::size_t c = 0; c < values.width; ++c) {
            const float value = values.values[i * values.width + c];
            if (!std::isfinite(value)) ++loading.notes["vertex colours that are not finite are read as 1"];
            color[static_cast<int>(c)] = std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : 1.0f;
        }
        colors[range.first + i] = color;
    }
}

// Positions that are all zero because no data is given belong to a mesh whose data only an extension can
// unpack.
void check_has_data(const Loading& loading, const Part& part, std::size_t positions) {
    const tinygltf::Accessor& accessor = loading.document.model.accessors[positions];
    if (accessor.bufferView != -1 || accessor.sparse.isSparse) return;
    const bool is_draco = part.primitive.extensions.contains("KHR_draco_mesh_compression");
    throw MeshFault(
        fmt::format("accessors[{}] holds positions, but has no data{}", positions,
                    is_draco ? " but that of KHR_draco_mesh_compression, which is not read" : ""));
}

VertexRange append_vertices(Loading& loading, const AttributeKey& key, const glm::dmat4& matrix) {
    const AccessorValues local = read_accessor(loading.document, *key[0]);
    if (local.width != 3)
        throw MeshFault(fmt::format("accessors[{}] holds positions, but is not VEC3", *key[0]));
    std::vector<glm::dvec3>& positions = loading.mesh.positions;
    const std::uint64_t limit = loading.document.limits.vertices;
    if (local.count > limit - positions.size())
        throw MeshFault(fmt::format("over {} vertices are not read", limit));
    const VertexRange range = {checked_cast<std::uint32_t>(positions.size(), "vertices"),
                               checked_cast<std::uint32_t>(local.count, "vertices")};
    append_uv(loading, key[1], range, loading.mesh.uv0);
    append_uv(loading, key[2], range, loading.mesh.uv1);
    append_colors(loading, key[3], range);
    for (std::size_t i = 0; i < local.count; ++i) {
        const glm::dvec4 p(local.values[3 * i], local.values[3 * i + 1], local.values[3 * i + 2], 1.0);
        positions.emplace_back(matrix * p);
    }
    return range;
}

// The corners of the triangles of a list, a strip or a fan of `count` vertices. Source: glTF 2.0, section
// 3.7.2.1.
enum class Topology { list = 4, strip = 5, fan = 6 };

glm::uvec3 triangle_corners(Topology topology, std::uint32_t i) {
    switch (topology) {
        case Topology::list:
            return {3 * i, 3 * i + 1, 3 * i + 2};
        case Topology::strip:
            return {i, i + 1 + i % 2, i + 2 - i % 2};
        case Topology::fan:
            return {0, i + 1, i + 2};
    }
    return {};
}

std::uint32_t triangle_count(Topology topology, std::uint32_t vertices) {
    if (topology == Topology::list) return vertices / 3;
    return vertices < 3 ? 0 : vertices - 2;
}

struct Corners {
    std::vector<std::uint32_t> indices;  // empty: the vertices in their order
    VertexRange vertices;
    Topology topology = Topology::list;
    bool is_mirrored = false;  // the node reverses the winding order; see glTF 2.0, section 3.7.4
};

void append_triangles(Loading& loading, const Corners& corners, std::uint32_t material, bool is_indexed) {
    const std::uint32_t ends =
        is_indexed ? static_cast<std::uint32_t>(corners.indices.size()) : corners.vertices.count;
    const std::uint32_t count = triangle_count(corners.topology, ends);
    std::vector<MeshTriangle>& triangles = loading.mesh.triangles;
    const std::uint64_t limit = loading.document.limits.triangles;
    if (count > limit - loading.triangles_read)
        throw MeshFault(fmt::format("over {} triangles are not read", limit));
    loading.triangles_read += count;
    for (std::uint32_t i = 0; i < count; ++i) {
        MeshTriangle triangle{.vertices = triangle_corners(corners.topology, i), .material = material};
        bool is_whole = true;
        for (int c = 0; c < 3; ++c) {
            std::uint32_t& vertex = triangle.vertices[c];
            vertex = corners.vertices.first + (is_indexed ? corners.indices[vertex] : vertex);
            is_whole = is_whole && is_finite(loading.mesh.positions[vertex]);
        }
        if (corners.is_mirrored) std::swap(triangle.vertices.x, triangle.vertices.y);
        if (is_whole)
            triangles.push_back(triangle);
        else
            ++loading.notes["a triangle is left out: a vertex is not finite"];
    }
}

bool holds_triangles(const Part& part, MeshNotes& notes) {
    const int mode = part.primitive.mode;
    if (mode < 0 || mode > 6)
        throw MeshFault(fmt::format("{}.mode {} is not one of glTF 2.0", part.name, mode));
    if (mode < 4) ++notes["points or lines are left out"];
    return mode >= 4;
}

void append_primitive(Loading& loading, const Part& part, const glm::dmat4& matrix,
                      std::map<AttributeKey, VertexRange>& shared) {
    if (++loading.parts_read > loading.document.limits.parts)
        throw MeshFault(fmt::format("over {} parts of meshes are not read", loading.document.limits.parts));
    if (!holds_triangles(part, loading.notes)) return;
    const AttributeKey key = read_attributes(loading, part);
    const tinygltf::Model& model = loading.document.model;
    if (!key[0]) {
        ++loading.notes["a part of a mesh is left out: it has no positions"];
        return;
    }
    if (!part.primitive.targets.empty())
        ++loading.notes["morph targets are ignored: the mesh is read without them"];
    check_has_data(loading, part, *key[0]);
    if (!shared.contains(key)) shared[key] = append_vertices(loading, key, matrix);
    Corners corners{.vertices = shared[key],
                    .topology = static_cast<Topology>(part.primitive.mode),
                    .is_mirrored = glm::determinant(glm::dmat3(matrix)) < 0.0};
    const auto indices =
        checked_index(part.primitive.indices, model.accessors.size(), part.name + ".indices", "accessors");
    if (indices) corners.indices = read_vertex_indices(loading.document, *indices, corners.vertices.count);
    const MaterialUse use = {
        checked_index(part.primitive.material, model.materials.size(), part.name + ".material", "materials"),
        key[1].has_value(), key[2].has_value()};
    const std::uint32_t material =
        use_material(loading.document, use, loading.materials, loading.mesh, loading.notes);
    append_triangles(loading, corners, material, indices.has_value());
}

}  // namespace

Mesh load_gltf(std::span<const std::byte> bytes, const std::filesystem::path& folder,
               const MeshRequest& request, MeshNotes& notes) {
    Loading loading{.document = parse_gltf(bytes, folder, request.limits, notes),
                    .materials = {},
                    .mesh = {},
                    .notes = notes};
    loading.materials.budget.limits = request.limits;
    const tinygltf::Model& model = loading.document.model;
    PlacedNodes placed = place_nodes(loading.document, request.scene, notes);
    loading.mesh.cameras = std::move(placed.cameras);
    for (const PlacedMesh& place : placed.meshes) {
        const auto& primitives = model.meshes[place.mesh].primitives;
        std::map<AttributeKey, VertexRange> shared;
        for (std::size_t i = 0; i < primitives.size(); ++i) {
            const Part part = {primitives[i], fmt::format("meshes[{}].primitives[{}]", place.mesh, i)};
            append_primitive(loading, part, place.matrix, shared);
        }
    }
    return std::move(loading.mesh);
}

}  // namespace voxilux
