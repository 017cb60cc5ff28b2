#include "voxelizer/load_ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "base/colour.h"
#include "base/printable.h"
#include "voxelizer/ply_values.h"
#include "voxelizer/polygon.h"

namespace voxilux {
namespace {

// The slots of a vertex's values: x, y, z, red, green, blue.
constexpr std::size_t kSlots = 6;

std::optional<std::size_t> slot_of(std::string_view name) {
    constexpr std::string_view kNames[] = {
        "x", "y", "z", "red",         "green",         "blue",        "", "", "", "r", "g", "b",
        "",  "",  "",  "diffuse_red", "diffuse_green", "diffuse_blue"};
    const auto found = std::ranges::find(kNames, name);
    if (name.empty() || found == std::end(kNames)) return std::nullopt;
    return static_cast<std::size_t>(found - kNames) % kSlots;
}

class PlyReader {
  public:
    PlyReader(std::span<const std::byte> bytes, const MeshRequest& request, MeshNotes& notes)
        : request_(request), notes_(notes), header_(read_ply_header(bytes)), values_(bytes, header_) {
        mesh_.is_z_up = true;
        mesh_.materials.push_back({.name = "default", .metallic = 0.0f});
    }

    Mesh read() {
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex")
                read_vertices(element);
            else if (element.name == "face")
                read_faces(element);
            else
                skip(element);
        }
        if (mesh_.positions.empty()) throw MeshFault("there is no vertex");
        return std::move(mesh_);
    }

  private:
    void skip(const PlyElement& element) {
        if (element.count > 0) ++notes_[fmt::format("element {} is not read", quoted_name(element.name))];
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (const PlyProperty& property : element.properties)
                values_.skip(property);
        }
    }

    void read_vertices(const PlyElement& element) {
        if (!mesh_.positions.empty()) throw MeshFault("the file has vertices twice");
        if (element.count > request_.limits.vertices)
            throw MeshFault(fmt::format("over {} vertices are not read", request_.limits.vertices));
        std::array<bool, kSlots> has{};
        for (const PlyProperty& property : element.properties) {
            if (const auto slot = slot_of(property.name); slot && !property.is_list) has[*slot] = true;
        }
        if (!has[0] || !has[1] || !has[2]) throw MeshFault("a vertex has no x, y and z");
        const bool has_colour = has[3] && has[4] && has[5];
        mesh_.positions.reserve(element.count);
        if (has_colour) mesh_.colors.reserve(element.count);
        for (std::uint64_t i = 0; i < element.count; ++i)
            read_vertex(element, has_colour);
    }

    // Colours of 8 and 16 bits are sRGB, and so are floats, because most programs write them that way.
    void read_vertex(const PlyElement& element, bool has_colour) {
        std::array<double, kSlots> vertex{};
        for (const PlyProperty& property : element.properties) {
            const auto slot = property.is_list ? std::nullopt : slot_of(property.name);
            if (!slot) {
                values_.skip(property);
                continue;
            }
            const double value = values_.next(property.type);
            vertex[*slot] = *slot < 3 ? value : value / full_scale(property.type);
        }
        mesh_.positions.emplace_back(vertex[0], vertex[1], vertex[2]);
        if (!has_colour) return;
        glm::vec4 colour(1.0f);
        for (int i = 0; i < 3; ++i) {
            const double srgb = vertex[static_cast<std::size_t>(3 + i)];
            colour[i] = static_cast<float>(decode_srgb(srgb > 0.0 ? std::min(srgb, 1.0) : 0.0));
        }
        mesh_.colors.push_back(colour);
    }

    void read_faces(const PlyElement& element) {
        if (mesh_.positions.empty() && element.count > 0) throw MeshFault("faces come before the vertices");
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (const PlyProperty& property : element.properties) {
                const bool is_corners = property.is_list && (property.name == "vertex_indices" ||
                                                             property.name == "vertex_index");
                is_corners ? read_face(property) : values_.skip(property);
            }
        }
    }

    void read_face(const PlyProperty& property) {
        const std::uint64_t count = values_.next_count(property.count_type);
        std::vector<std::uint32_t> vertices;
        std::vector<glm::dvec3> corners;
        for (std::uint64_t i = 0; i < count; ++i) {
            const double index = values_.next(property.type);
            if (!(index >= 0.0 && index < static_cast<double>(mesh_.positions.size())))
                throw MeshFault(fmt::format("a face names vertex {} of {}", index, mesh_.positions.size()));
            vertices.push_back(static_cast<std::uint32_t>(index));
            corners.push_back(mesh_.positions[vertices.back()]);
        }
        if (count < 3) {
            ++notes_["a face of fewer than three corners is left out"];
            return;
        }
        if (mesh_.triangles.size() + count - 2 > request_.limits.triangles)
            throw MeshFault(fmt::format("over {} triangles are not read", request_.limits.triangles));
        if (!std::ranges::all_of(corners, is_finite)) {
            notes_["a triangle is left out: a vertex is not finite"] += count - 2;
            return;
        }
        for (const auto& [a, b, c] : triangulate(corners))
            mesh_.triangles.push_back({{vertices[a], vertices[b], vertices[c]}, 0});
    }

    const MeshRequest& request_;
    MeshNotes& notes_;
    PlyHeader header_;
    PlyValues values_;
    Mesh mesh_;
};

}  // namespace

Mesh load_ply(std::span<const std::byte> bytes, const std::filesystem::path&, const MeshRequest& request,
              MeshNotes& notes) {
    return PlyReader(bytes, request, notes).read();
}

}  // namespace voxilux
