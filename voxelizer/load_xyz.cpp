#include "voxelizer/load_xyz.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "base/colour.h"
#include "voxelizer/obj_text.h"

namespace voxilux {
namespace {

bool is_code(double value) {
    return value >= 0.0 && value <= 255.0 && value == std::floor(value);
}

// Reads the first six numbers of a line and returns how many it has.
std::size_t read_point(ObjLines& lines, double (&numbers)[6]) {
    std::size_t count = 0;
    for (auto number = lines.next_number(); number; number = lines.next_number(), ++count)
        if (count < std::size(numbers)) numbers[count] = *number;
    return count;
}

}  // namespace

Mesh load_xyz(std::span<const std::byte> bytes, const std::filesystem::path&, const MeshRequest& request,
              MeshNotes& notes) {
    Mesh mesh;
    mesh.is_z_up = true;
    mesh.materials.push_back({.name = "default", .metallic = 0.0f});
    ObjLines lines({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    bool is_first = true, has_colours = true;
    while (lines.next_line()) {
        double n[6];
        const std::size_t count = read_point(lines, n);
        if (count == 1 && std::exchange(is_first, false)) continue;
        is_first = false;
        if (count < 3) lines.refuse("a point has fewer than three numbers");
        if (mesh.positions.size() >= request.limits.vertices)
            lines.refuse(fmt::format("over {} points are not read", request.limits.vertices));
        mesh.positions.emplace_back(n[0], n[1], n[2]);
        has_colours = has_colours && count == 6 && is_code(n[3]) && is_code(n[4]) && is_code(n[5]);
        if (!has_colours) {
            if (count > 3 || !mesh.colors.empty())
                ++notes["colours are left out: a line is not x y z and three whole numbers from 0 to 255"];
            continue;
        }
        mesh.colors.emplace_back(linear_from_srgb(static_cast<std::uint8_t>(n[3])),
                                 linear_from_srgb(static_cast<std::uint8_t>(n[4])),
                                 linear_from_srgb(static_cast<std::uint8_t>(n[5])), 1.0f);
    }
    if (mesh.positions.empty()) throw MeshFault("there is no point");
    if (!has_colours) mesh.colors = {};
    return mesh;
}

}  // namespace voxilux
