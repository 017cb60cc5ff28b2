#include "voxelize/gltf_nodes.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

namespace voxilux {
namespace {

glm::dmat4 local_matrix(const JsonItem& node) {
    std::array<double, 16> m{};
    if (read_numbers(node, "matrix", m)) {
        glm::dmat4 matrix{1.0};
        for (std::size_t i = 0; i < m.size(); ++i)
            matrix[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = m[i];
        return matrix;
    }
    std::array<double, 3> t = {0, 0, 0}, s = {1, 1, 1};
    std::array<double, 4> r = {0, 0, 0, 1};
    read_numbers(node, "translation", t);
    read_numbers(node, "rotation", r);
    read_numbers(node, "scale", s);
    const double length = std::hypot(std::hypot(r[0], r[1]), std::hypot(r[2], r[3]));
    if (length == 0.0) throw MeshFault(node.name + ".rotation is zero");
    // Read as it stands: the specification asks for a unit quaternion, and rounding is not a fault.
    glm::dmat4 matrix =
        glm::mat4_cast(glm::dquat(r[3] / length, r[0] / length, r[1] / length, r[2] / length));
    for (int column = 0; column < 3; ++column)
        matrix[column] *= s[static_cast<std::size_t>(column)];
    matrix[3] = glm::dvec4(t[0], t[1], t[2], 1.0);
    return matrix;
}

bool is_direction(const glm::dvec3& v) {
    const double length = glm::length(v);
    return std::isfinite(length) && length > 0.0;
}

void place_camera(const JsonItem& root, std::size_t index, const glm::dmat4& matrix, PlacedNodes& placed,
                  MeshNotes& notes) {
    const JsonItem item = list_item(root, "cameras", index);
    const double fov_y = read_number(child(item, "perspective"), "yfov", 0.0);
    if (fov_y <= 0.0 || fov_y >= std::numbers::pi) {
        ++notes["a camera is left out: it is not a perspective one with an angle below 180 degrees"];
        return;
    }
    const glm::dvec3 forward = -glm::dvec3(matrix[2]), up = glm::dvec3(matrix[1]),
                     position = glm::dvec3(matrix[3]);
    if (!is_direction(forward) || !is_direction(up) || !std::isfinite(glm::length(position))) {
        ++notes["a camera is left out: its place is not finite"];
        return;
    }
    placed.cameras.push_back({.name = read_text(item, "name", ""),
                              .position = position,
                              .forward = glm::normalize(forward),
                              .up = glm::normalize(up),
                              .fov_y_deg = glm::degrees(fov_y)});
}

std::string scene_list(const JsonItem& root) {
    constexpr std::size_t kMostShown = 8;
    const std::size_t count = list_size(root, "scenes");
    std::string list;
    for (std::size_t i = 0; i < std::min(count, kMostShown); ++i)
        list += fmt::format("{}{} {}", i == 0 ? "" : ", ", i,
                            quoted_name(read_text(list_item(root, "scenes", i), "name", "")));
    return list + (count > kMostShown ? ", ..." : "");
}

std::vector<std::size_t> all_roots(const JsonItem& root) {
    const std::size_t count = list_size(root, "nodes");
    std::vector<bool> is_child(count, false);
    for (std::size_t i = 0; i < count; ++i) {
        for (const std::size_t node : read_indices(list_item(root, "nodes", i), "children", root, "nodes"))
            is_child[node] = true;
    }
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < count; ++i) {
        if (!is_child[i]) roots.push_back(i);
    }
    return roots;
}

std::vector<std::size_t> scene_roots(const JsonItem& root, std::optional<std::size_t> wanted) {
    const std::size_t count = list_size(root, "scenes");
    if (count == 0 && !wanted) return all_roots(root);
    if (wanted && *wanted >= count)
        throw MeshFault(
            fmt::format("there is no scene {}; the file has {}: {}", *wanted, count, scene_list(root)));
    const std::size_t scene = wanted ? *wanted : read_index(root, "scene", root, "scenes").value_or(0);
    return read_indices(list_item(root, "scenes", scene), "nodes", root, "nodes");
}

struct Step {
    std::size_t node = 0;
    glm::dmat4 parent{1.0};
};

}  // namespace

PlacedNodes place_nodes(const JsonItem& root, std::optional<std::size_t> scene, MeshNotes& notes) {
    PlacedNodes placed;
    std::vector<bool> is_reached(list_size(root, "nodes"), false);
    std::vector<Step> open;
    const auto enter = [&](const std::vector<std::size_t>& nodes, const glm::dmat4& parent) {
        for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
            if (is_reached[*node])
                throw MeshFault(fmt::format("nodes[{}] is reached twice: a cycle, or two parents", *node));
            is_reached[*node] = true;
            open.push_back({*node, parent});
        }
    };
    enter(scene_roots(root, scene), glm::dmat4(1.0));
    while (!open.empty()) {
        const Step step = open.back();
        open.pop_back();
        const JsonItem node = list_item(root, "nodes", step.node);
        const glm::dmat4 matrix = step.parent * local_matrix(node);
        enter(read_indices(node, "children", root, "nodes"), matrix);
        if (const auto camera = read_index(node, "camera", root, "cameras"))
            place_camera(root, *camera, matrix, placed, notes);
        const auto mesh = read_index(node, "mesh", root, "meshes");
        if (mesh) placed.meshes.push_back({*mesh, matrix});
        if (mesh && has(node, "skin")) ++notes["a skin is ignored: the mesh is read in its pose of rest"];
    }
    return placed;
}

}  // namespace voxilux
