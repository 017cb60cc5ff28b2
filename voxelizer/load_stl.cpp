#include "voxelizer/load_stl.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>

#include "base/checked_cast.h"
#include "base/printable.h"
#include "voxelizer/obj_text.h"

namespace voxilux {
namespace {

constexpr std::size_t kStlHeadBytes = 84;      // a title of 80, and the number of triangles
constexpr std::size_t kStlTriangleBytes = 50;  // normal, three corners, attribute

std::uint32_t stl_word(std::span<const std::byte> bytes, std::size_t at) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i)
        word |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
    return word;
}

// Where the triangles of a binary file end; nothing for text. Titles of binary files may begin with "solid",
// too, and some programs append bytes. A triangle count made of letters, however, would need gigabytes.
std::optional<std::uint64_t> stl_binary_end(std::span<const std::byte> bytes) {
    if (bytes.size() < kStlHeadBytes) return std::nullopt;
    const std::uint64_t triangles = stl_word(bytes, kStlHeadBytes - 4);
    const std::uint64_t end = kStlHeadBytes + kStlTriangleBytes * triangles;
    const bool fits = triangles == 0 ? bytes.size() == end : bytes.size() >= end;
    return fits ? std::optional(end) : std::nullopt;
}

std::string lower_case(std::string_view word) {
    std::string lower(word);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return lower;
}

class StlMesh {
  public:
    StlMesh(const MeshRequest& request, MeshNotes& notes) : limit_(request.limits.triangles), notes_(notes) {
        mesh_.is_z_up = true;
        mesh_.materials.push_back({.name = "default", .metallic = 0.0f});
    }

    void check_count(std::uint64_t triangles) const {
        if (triangles > limit_) throw MeshFault(fmt::format("over {} triangles are not read", limit_));
    }

    void add(const glm::dvec3 (&corners)[3]) {
        check_count(mesh_.triangles.size() + 1);
        if (!std::ranges::all_of(corners, is_finite)) {
            ++notes_["a triangle is left out: a vertex is not finite"];
            return;
        }
        const auto first = checked_cast<std::uint32_t>(mesh_.positions.size(), "vertices");
        mesh_.positions.insert(mesh_.positions.end(), std::begin(corners), std::end(corners));
        mesh_.triangles.push_back({{first, first + 1, first + 2}, 0});
    }

    [[nodiscard]] Mesh take() { return std::move(mesh_); }

  private:
    std::uint64_t limit_;
    MeshNotes& notes_;
    Mesh mesh_;
};

void read_stl_binary(std::span<const std::byte> bytes, StlMesh& mesh) {
    mesh.check_count(stl_word(bytes, kStlHeadBytes - 4));
    for (std::size_t at = kStlHeadBytes; at < bytes.size(); at += kStlTriangleBytes) {
        glm::dvec3 corners[3];
        for (std::size_t i = 0; i < 9; ++i)
            corners[i / 3][static_cast<int>(i % 3)] = std::bit_cast<float>(stl_word(bytes, at + 12 + 4 * i));
        mesh.add(corners);
    }
}

// Case-insensitive. "facet normal", "outer loop" and their ends add nothing to the three vertices.
void read_stl_text(std::string_view text, StlMesh& mesh) {
    constexpr std::string_view kOther[] = {"solid", "facet", "outer", "endloop", "endfacet", "endsolid"};
    ObjLines lines(text, LineRules::plain);
    if (text.find('\0') != text.npos || !lines.next_line() || lower_case(lines.next_word()) != "solid")
        throw MeshFault(
            "not an STL file: neither text that begins with 'solid' nor binary of the right size");
    glm::dvec3 corners[3];
    int known = 0;
    while (lines.next_line()) {
        const std::string key = lower_case(lines.next_word());
        if (key == "vertex") {
            if (known == 3) lines.refuse("a facet has more than three vertices");
            for (int axis = 0; axis < 3; ++axis)
                corners[known][axis] = lines.require_number();
            ++known;
        } else if (key == "endfacet") {
            if (known != 3) lines.refuse("a facet has fewer than three vertices");
            mesh.add(corners);
            known = 0;
        } else if (std::ranges::find(kOther, key) == std::end(kOther)) {
            lines.refuse(fmt::format("{} is no word of an STL file", quoted_name(key)));
        }
    }
    if (known != 0) lines.refuse("the last facet has no end");
}

}  // namespace

Mesh load_stl(std::span<const std::byte> bytes, const std::filesystem::path&, const MeshRequest& request,
              MeshNotes& notes) {
    StlMesh mesh(request, notes);
    if (const auto end = stl_binary_end(bytes)) {
        if (*end < bytes.size()) ++notes["bytes after the last triangle are left out"];
        read_stl_binary(bytes.first(*end), mesh);
    } else {
        read_stl_text({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, mesh);
    }
    return mesh.take();
}

}  // namespace voxilux
