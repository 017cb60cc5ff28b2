#include "voxelizer/gltf_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "voxelizer/load_mesh.h"

namespace voxilux {
namespace {

// `numbers`, or `fallback` where there are none.
template <std::size_t size>
std::array<double, size> numbers_or(const std::vector<double>& numbers, const std::string& name,
                                    const std::array<double, size>& fallback) {
    if (numbers.empty()) return fallback;
    if (numbers.size() != size)
        throw MeshFault(fmt::format("{} has {} numbers, not {}", name, numbers.size(), size));
    std::array<double, size> result{};
    std::ranges::copy(numbers, result.begin());
    return result;
}

glm::dmat4 local_matrix(const tinygltf::Node& node, const std::string& name) {
    if (!node.matrix.empty()) {
        const auto m = numbers_or<16>(node.matrix, name + ".matrix", {});
        glm::dmat4 matrix{1.0};
        for (std::size_t i = 0; i < m.size(); ++i)
            matrix[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = m[i];
        return matrix;
    }
    const auto t = numbers_or<3>(node.translation, name + ".translation", {0, 0, 0});
    const auto r = numbers_or<4>(node.rotation, name + ".rotation", {0, 0, 0, 1});
    const auto s = numbers_or<3>(node.scale, name + ".scale", {1, 1, 1});
    const double length = std::hypot(std::hypot(r[0], r[1]), std::hypot(r[2], r[3]));
    if (length == 0.0) throw MeshFault(name + ".rotation is zero");
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

void place_camera(const tinygltf::Camera& camera, const glm::dmat4& matrix, PlacedNodes& placed,
                  MeshNotes& notes) {
    const double fov_y = camera.perspective.yfov;
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
    placed.cameras.push_back({.name = camera.name,
                              .position = position,
                              .forward = glm::normalize(forward),
                              .up = glm::normalize(up),
                              .fov_y_deg = glm::degrees(fov_y)});
}

std::string scene_list(const tinygltf::Model& model) {
    constexpr std::size_t kMostShown = 8;
    const std::size_t count = model.scenes.size();
    std::string list;
    for (std::size_t i = 0; i < std::min(count, kMostShown); ++i)
        list += fmt::format("{}{} {}", i == 0 ? "" : ", ", i, quoted_name(model.scenes[i].name));
    return list + (count > kMostShown ? ", ..." : "");
}

std::vector<std::size_t> checked_nodes(const tinygltf::Model& model, const std::vector<int>& indices,
                                       const std::string& owner) {
    std::vector<std::size_t> nodes;
    for (const int index : indices) {
        if (const auto node = checked_index(index, model.nodes.size(), owner, "nodes"))
            nodes.push_back(*node);
    }
    return nodes;
}

std::vector<std::size_t> children_of(const tinygltf::Model& model, std::size_t node) {
    return checked_nodes(model, model.nodes[node].children, fmt::format("nodes[{}].children", node));
}

std::vector<std::size_t> all_roots(const tinygltf::Model& model) {
    std::vector<bool> is_child(model.nodes.size(), false);
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        for (const std::size_t node : children_of(model, i))
            is_child[node] = true;
    }
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        if (!is_child[i]) roots.push_back(i);
    }
    return roots;
}

std::vector<std::size_t> scene_roots(const tinygltf::Model& model, std::optional<std::size_t> wanted) {
    const std::size_t count = model.scenes.size();
    if (count == 0 && !wanted) return all_roots(model);
    if (wanted && *wanted >= count)
        throw MeshFault(
            fmt::format("there is no scene {}; the file has {}: {}", *wanted, count, scene_list(model)));
    const std::size_t scene =
        wanted ? *wanted : checked_index(model.defaultScene, count, "scene", "scenes").value_or(0);
    return checked_nodes(model, model.scenes[scene].nodes, fmt::format("scenes[{}].nodes", scene));
}

struct Step {
    std::size_t node = 0;
    glm::dmat4 parent{1.0};
};

}  // namespace

PlacedNodes place_nodes(const tinygltf::Model& model, std::optional<std::size_t> scene, MeshNotes& notes) {
    PlacedNodes placed;
    std::vector<bool> is_reached(model.nodes.size(), false);
    std::vector<Step> open;
    const auto enter = [&](const std::vector<std::size_t>& nodes, const glm::dmat4& parent) {
        for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
            if (is_reached[*node])
                throw MeshFault(fmt::format("nodes[{}] is reached twice: a cycle, or two parents", *node));
            is_reached[*node] = true;
            open.push_back({*node, parent});
        }
    };
    enter(scene_roots(model, scene), glm::dmat4(1.0));
    while (!open.empty()) {
        const Step step = open.back();
        open.pop_back();
        const tinygltf::Node& node = model.nodes[step.node];
        const std::string name = fmt::format("nodes[{}]", step.node);
        const glm::dmat4 matrix = step.parent * local_matrix(node, name);
        enter(children_of(model, step.node), matrix);
        if (const auto camera = checked_index(node.camera, model.cameras.size(), name + ".camera", "cameras"))
            place_camera(model.cameras[*camera], matrix, placed, notes);
        const auto mesh = checked_index(node.mesh, model.meshes.size(), name + ".mesh", "meshes");
        if (mesh) placed.meshes.push_back({*mesh, matrix});
        if (mesh && node.skin != -1) ++notes["a skin is ignored: the mesh is read in its pose of rest"];
    }
    return placed;
}

}  // namespace voxilux
