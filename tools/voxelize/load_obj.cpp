#include "voxelize/load_obj.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <array>
#include <cmath>
#include <sstream>
#include <unordered_map>

#include "base/checked_cast.h"
#include "base/error.h"
#include "base/file.h"
#include "voxelize/obj_material.h"

namespace voxilux {
namespace {

std::string text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Opens the MTL files that an OBJ names, beside it and not in the working folder.
class MtlBeside : public tinyobj::MaterialReader {
  public:
    MtlBeside(std::filesystem::path folder, std::uint64_t limit, MeshNotes& notes)
        : folder_(std::move(folder)), limit_(limit), notes_(notes) {}

    bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                    std::map<std::string, int>* indices, std::string* warning, std::string* error) override {
        try {
            std::istringstream text(text_of(read_file(find_beside(folder_, name), limit_)));
            tinyobj::LoadMtl(indices, materials, &text, warning, error);
        } catch (const MeshFault& fault) {
            ++notes_[fmt::format("materials are left out: {}", fault.what())];
        } catch (const Error& fault) {
            ++notes_[fmt::format("materials are left out: {}", fault.what())];
        }
        return true;  // what is missing is noted here
    }

  private:
    std::filesystem::path folder_;
    std::uint64_t limit_;
    MeshNotes& notes_;
};

struct ObjText {
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
};

std::string first_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

ObjText parse_obj(std::span<const std::byte> bytes, const std::filesystem::path& folder,
                  const MeshRequest& request, MeshNotes& notes) {
    ObjText obj;
    std::string warning, error;
    std::istringstream text(text_of(bytes));
    MtlBeside mtl(folder, request.limits.file_bytes, notes);
    const bool is_read = tinyobj::LoadObj(&obj.attributes, &obj.shapes, &obj.materials, &warning, &error,
                                          &text, &mtl, true, false);
    if (!is_read) throw MeshFault(error.empty() ? "not a readable OBJ file" : first_line(error));
    if (!warning.empty()) ++notes[first_line(warning)];
    return obj;
}

struct Loading {
    const ObjText& obj;
    const MeshLimits& limits;
    Mesh mesh;
    MeshNotes& notes;
    std::unordered_map<std::uint64_t, std::uint32_t> vertices;  // by place and texture coordinate
    std::uint32_t default_material = 0;
};

float linear_from_srgb_value(double s) {
    const double c = std::clamp(std::isfinite(s) ? s : 1.0, 0.0, 1.0);
    return static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
}

std::uint32_t add_vertex(Loading& loading, std::size_t place, std::optional<std::size_t> uv) {
    const tinyobj::attrib_t& from = loading.obj.attributes;
    Mesh& mesh = loading.mesh;
    if (mesh.positions.size() >= loading.limits.vertices)
        throw MeshFault(fmt::format("over {} vertices are not read", loading.limits.vertices));
    mesh.positions.emplace_back(from.vertices[3 * place], from.vertices[3 * place + 1],
                                from.vertices[3 * place + 2]);
    if (!from.texcoords.empty()) {
        glm::dvec2 at(0.0);
        if (uv) at = {from.texcoords[2 * *uv], 1.0 - from.texcoords[2 * *uv + 1]};
        const bool is_finite = std::isfinite(at.x) && std::isfinite(at.y);
        if (!is_finite) ++loading.notes["texture coordinates that are not finite are read as 0"];
        mesh.uv0.emplace_back(is_finite ? glm::vec2(at) : glm::vec2(0.0f));
    }
    if (3 * place + 2 < from.colors.size()) {
        const auto component = [&](std::size_t c) {
            return linear_from_srgb_value(from.colors[3 * place + c]);
        };
        mesh.colors.emplace_back(component(0), component(1), component(2), 1.0f);
    }
    return checked_cast<std::uint32_t>(mesh.positions.size() - 1, "vertices");
}

std::uint32_t vertex_of(Loading& loading, const tinyobj::index_t& corner) {
    const std::size_t places = loading.obj.attributes.vertices.size() / 3;
    const std::size_t uvs = loading.obj.attributes.texcoords.size() / 2;
    const auto place = static_cast<std::size_t>(corner.vertex_index);
    if (corner.vertex_index < 0 || place >= places)
        throw MeshFault(
            fmt::format("a face names vertex {} of {}", std::int64_t{corner.vertex_index} + 1, places));
    std::optional<std::size_t> uv;
    if (corner.texcoord_index >= 0) uv = static_cast<std::size_t>(corner.texcoord_index);
    if (uv && *uv >= uvs)
        throw MeshFault(fmt::format("a face names texture coordinate {} of {}", *uv + 1, uvs));
    const std::uint64_t key = place << 32 | (uv ? *uv + 1 : 0);
    const auto found = loading.vertices.find(key);
    if (found != loading.vertices.end()) return found->second;
    const std::uint32_t added = add_vertex(loading, place, uv);
    loading.vertices.emplace(key, added);
    return added;
}

bool is_finite(const glm::dvec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

void add_triangle(Loading& loading, const tinyobj::mesh_t& shape, std::size_t face) {
    if (loading.mesh.triangles.size() >= loading.limits.triangles)
        throw MeshFault(fmt::format("over {} triangles are not read", loading.limits.triangles));
    MeshTriangle triangle;
    bool is_whole = true;
    for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t vertex = vertex_of(loading, shape.indices[3 * face + c]);
        triangle.vertices[static_cast<int>(c)] = vertex;
        is_whole = is_whole && is_finite(loading.mesh.positions[vertex]);
    }
    const int material = face < shape.material_ids.size() ? shape.material_ids[face] : -1;
    const bool is_known = material >= 0 && static_cast<std::size_t>(material) < loading.obj.materials.size();
    triangle.material = is_known ? static_cast<std::uint32_t>(material) : loading.default_material;
    if (is_whole)
        loading.mesh.triangles.push_back(triangle);
    else
        ++loading.notes["a triangle is left out: a vertex is not finite"];
}

}  // namespace

Mesh load_obj(std::span<const std::byte> bytes, const std::filesystem::path& folder,
              const MeshRequest& request, MeshNotes& notes) {
    const ObjText obj = parse_obj(bytes, folder, request, notes);
    Loading loading{.obj = obj, .limits = request.limits, .mesh = {}, .notes = notes, .vertices = {}};
    ObjTextures textures{.folder = folder, .budget = {.limits = request.limits}, .known = {}};
    for (const tinyobj::material_t& mtl : obj.materials)
        loading.mesh.materials.push_back(material_from_mtl(mtl, textures, loading.mesh, notes));
    loading.default_material = checked_cast<std::uint32_t>(loading.mesh.materials.size(), "materials");
    loading.mesh.materials.push_back({.name = "default", .metallic = 0.0f});
    for (const tinyobj::shape_t& shape : obj.shapes) {
        for (std::size_t face = 0; face < shape.mesh.indices.size() / 3; ++face)
            add_triangle(loading, shape.mesh, face);
    }
    return std::move(loading.mesh);
}

}  // namespace voxilux
