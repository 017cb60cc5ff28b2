#include "voxelizer/load_obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "base/checked_cast.h"
#include "base/colour.h"
#include "base/printable.h"
#include "voxelizer/load_mtl.h"
#include "voxelizer/mesh_features.h"
#include "voxelizer/obj_text.h"
#include "voxelizer/polygon.h"

namespace voxilux {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// The v and vt lines of the file.
struct ObjPoints {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec4> colors;  // linear; empty where no v line has any
    std::vector<glm::vec2> uvs;
};

// The vertex of the mesh that a v line first became, and its vt line.
struct FirstCopy {
    std::uint32_t vertex = kNone;
    std::uint32_t uv = kNone;
};

struct ObjLoading {
    const MeshRequest& request;
    MeshNotes& notes;
    ObjPoints points;
    MtlLibrary library;
    Mesh mesh;
    std::vector<FirstCopy> first_copies;                           // by v line
    std::unordered_map<std::uint64_t, std::uint32_t> more_copies;  // by v line << 32 | vt line
    std::size_t positions_so_far = 0;
    std::size_t uvs_so_far = 0;
    std::optional<std::uint32_t> material, default_material;
    std::uint64_t triangles_read = 0;
};

float linear_of(double srgb) {
    return static_cast<float>(decode_srgb(std::isfinite(srgb) ? std::clamp(srgb, 0.0, 1.0) : 1.0));
}

// x y z, x y z w, or x y z r g b.
void read_position(ObjLines& lines, ObjPoints& points) {
    const double x = lines.require_number(), y = lines.require_number(), z = lines.require_number();
    points.positions.emplace_back(x, y, z);
    const auto r = lines.next_number(), g = lines.next_number(), b = lines.next_number();
    if (!b && points.colors.empty()) return;
    points.colors.resize(points.positions.size(), glm::vec4(1.0f));
    if (b) points.colors.back() = {linear_of(*r), linear_of(*g), linear_of(*b), 1.0f};
}

void read_uv(ObjLines& lines, ObjPoints& points, MeshNotes& notes) {
    const double u = lines.require_number(), v = lines.next_number().value_or(0.0);
    const glm::vec2 uv(static_cast<float>(u), static_cast<float>(1.0 - v));  // texture row 0 is at the top
    const bool is_finite = std::isfinite(uv.x) && std::isfinite(uv.y);
    if (!is_finite) ++notes["texture coordinates that are not finite are read as 0"];
    points.uvs.push_back(is_finite ? uv : glm::vec2(0.0f));
}

// The rest of the line is one name with blanks if such a file exists; otherwise each word is a name.
void read_libraries(ObjLoading& loading, ObjLines& lines) {
    const std::string whole(lines.rest());
    std::error_code ignored;
    if (whole.find(' ') == std::string::npos ||
        std::filesystem::exists(loading.library.folder / whole, ignored))
        return load_mtl(whole, loading.library, loading.mesh, loading.notes);
    for (std::string_view word = lines.next_word(); !word.empty(); word = lines.next_word())
        load_mtl(std::string(word), loading.library, loading.mesh, loading.notes);
}

// Reads what faces refer to, wherever it is in the file.
void read_definitions(std::string_view text, ObjLoading& loading) {
    ObjLines lines(text);
    const std::uint64_t limit = loading.request.limits.vertices;
    while (lines.next_line()) {
        const std::string_view key = lines.next_word();
        if (key == "v") read_position(lines, loading.points);
        if (key == "vt") read_uv(lines, loading.points, loading.notes);
        if (key == "mtllib") read_libraries(loading, lines);
        if (loading.points.positions.size() > limit || loading.points.uvs.size() > limit)
            lines.refuse(fmt::format("over {} vertices are not read", limit));
    }
    ObjPoints& points = loading.points;
    if (!points.colors.empty()) points.colors.resize(points.positions.size(), glm::vec4(1.0f));
    loading.first_copies.assign(points.positions.size(), {});
}

// The vertex of the mesh for a v line and a vt line, or none.
std::uint32_t vertex_of(ObjLoading& loading, std::uint32_t position, std::uint32_t uv) {
    FirstCopy& first = loading.first_copies[position];
    if (first.vertex != kNone && first.uv == uv) return first.vertex;
    Mesh& mesh = loading.mesh;
    const auto added = checked_cast<std::uint32_t>(mesh.positions.size(), "vertices");
    if (first.vertex == kNone) {
        first = {added, uv};
    } else {
        const auto [found, is_new] =
            loading.more_copies.try_emplace(std::uint64_t{position} << 32 | uv, added);
        if (!is_new) return found->second;
    }
    mesh.positions.push_back(loading.points.positions[position]);
    if (!loading.points.uvs.empty())
        mesh.uv0.push_back(uv == kNone ? glm::vec2(0.0f) : loading.points.uvs[uv]);
    if (!loading.points.colors.empty()) mesh.colors.push_back(loading.points.colors[position]);
    return added;
}

// The line that an index of a face refers to: from 1, or from -1 backwards.
std::uint32_t line_of(const ObjLines& lines, std::string_view text, std::size_t so_far, std::size_t size) {
    std::int64_t index = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    if (error != std::errc() || end != text.data() + text.size())
        lines.refuse(fmt::format("{} is not an index", quoted_name(text)));
    const auto before = static_cast<std::int64_t>(so_far);
    const std::int64_t line = index > 0 ? index - 1 : index < -before ? -1 : before + index;
    if (index == 0 || line < 0 || line >= static_cast<std::int64_t>(size))
        lines.refuse(fmt::format("a face names line {} of {}", index, size));
    return static_cast<std::uint32_t>(line);
}

// v, v/vt, v//vn or v/vt/vn.
std::uint32_t read_corner(ObjLoading& loading, const ObjLines& lines, std::string_view word) {
    const std::size_t slash = std::min(word.find('/'), word.size());
    const std::uint32_t position =
        line_of(lines, word.substr(0, slash), loading.positions_so_far, loading.points.positions.size());
    std::string_view rest = word.substr(std::min(slash + 1, word.size()));
    rest = rest.substr(0, rest.find('/'));
    if (rest.empty()) return vertex_of(loading, position, kNone);
    return vertex_of(loading, position, line_of(lines, rest, loading.uvs_so_far, loading.points.uvs.size()));
}

std::uint32_t current_material(ObjLoading& loading) {
    if (loading.material) return *loading.material;
    if (!loading.default_material) {
        loading.mesh.materials.push_back({.name = "default", .metallic = 0.0f});
        loading.default_material =
            checked_cast<std::uint32_t>(loading.mesh.materials.size() - 1, "materials");
    }
    return *loading.default_material;
}

void read_face(ObjLoading& loading, ObjLines& lines) {
    std::vector<std::uint32_t> vertices;
    std::vector<glm::dvec3> corners;
    bool is_whole = true;
    for (std::string_view word = lines.next_word(); !word.empty(); word = lines.next_word()) {
        vertices.push_back(read_corner(loading, lines, word));
        corners.push_back(loading.mesh.positions[vertices.back()]);
        is_whole = is_whole && is_finite(corners.back());
    }
    if (vertices.size() < 3) lines.refuse("a face has fewer than three corners");
    loading.triangles_read += vertices.size() - 2;
    if (loading.triangles_read > loading.request.limits.triangles)
        lines.refuse(fmt::format("over {} triangles are not read", loading.request.limits.triangles));
    if (!is_whole) {
        loading.notes["a triangle is left out: a vertex is not finite"] += vertices.size() - 2;
        return;
    }
    const std::uint32_t material = current_material(loading);
    for (const auto& [a, b, c] : triangulate(corners))
        loading.mesh.triangles.push_back({{vertices[a], vertices[b], vertices[c]}, material});
}

void use_material(ObjLoading& loading, const ObjLines& lines) {
    const std::string name(lines.rest());
    const auto found = loading.library.materials.find(name);
    loading.material.reset();
    if (found != loading.library.materials.end())
        loading.material = found->second;
    else
        ++loading.notes[fmt::format("material {} is not there: white is used", quoted_name(name))];
}

void read_faces(std::string_view text, ObjLoading& loading) {
    ObjLines lines(text);
    while (lines.next_line()) {
        const std::string key(lines.next_word());
        if (key == "v")
            ++loading.positions_so_far;
        else if (key == "vt")
            ++loading.uvs_so_far;
        else if (key == "f")
            read_face(loading, lines);
        else if (key == "usemtl")
            use_material(loading, lines);
        else if (key != "vn" && key != "mtllib")
            note_feature(FeatureKind::obj_keyword, key, loading.notes);
    }
}

}  // namespace

Mesh load_obj(std::span<const std::byte> bytes, const std::filesystem::path& folder,
              const MeshRequest& request, MeshNotes& notes) {
    ObjLoading loading{.request = request, .notes = notes, .points = {}, .library = {}, .mesh = {}};
    loading.library.folder = folder;
    loading.library.budget.limits = request.limits;
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    read_definitions(text, loading);
    read_faces(text, loading);
    return std::move(loading.mesh);
}

}  // namespace voxilux
