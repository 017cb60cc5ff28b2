#include "voxelizer/gltf_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "base/printable.h"
#include "voxelizer/gltf_accessor.h"

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

// `t`, `r` (x, y, z, w) and `s` combined; nothing where the rotation is zero. A rotation is used
// unnormalised: the specification requires a unit quaternion, and rounding errors in it are no fault.
std::optional<glm::dmat4> placement(const std::array<double, 3>& t, const std::array<double, 4>& r,
                                    const std::array<double, 3>& s) {
    const double length = std::hypot(std::hypot(r[0], r[1]), std::hypot(r[2], r[3]));
    if (length == 0.0) return std::nullopt;
    glm::dmat4 matrix =
        glm::mat4_cast(glm::dquat(r[3] / length, r[0] / length, r[1] / length, r[2] / length));
    for (int column = 0; column < 3; ++column)
        matrix[column] *= s[static_cast<std::size_t>(column)];
    matrix[3] = glm::dvec4(t[0], t[1], t[2], 1.0);
    return matrix;
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
    const auto matrix = placement(t, r, s);
    if (!matrix) throw MeshFault(name + ".rotation is zero");
    return *matrix;
}

// The numbers of one attribute of EXT_mesh_gpu_instancing. Sets `count` for the first attribute; all others
// must have as many.
std::optional<AccessorValues> instance_attribute(const GltfDocument& document, const tinygltf::Value& list,
                                                 const char* key, std::size_t width, const std::string& name,
                                                 std::optional<std::size_t>& count) {
    if (!list.Has(key)) return std::nullopt;
    const std::string own_name = fmt::format("{}.extensions.EXT_mesh_gpu_instancing.{}", name, key);
    const auto index =
        checked_index(list.Get(key).GetNumberAsInt(), document.model.accessors.size(), own_name, "accessors");
    AccessorValues values = read_accessor(document, index.value());
    if (values.width != width)
        throw MeshFault(fmt::format("{} has elements of {} numbers, not {}", own_name, values.width, width));
    if (count && *count != values.count)
        throw MeshFault(
            fmt::format("{} has {} elements, another attribute {}", own_name, values.count, *count));
    count = values.count;
    return values;
}

template <std::size_t size>
std::array<double, size> element_or(const std::optional<AccessorValues>& values, std::size_t index,
                                    const std::array<double, size>& fallback) {
    if (!values) return fallback;
    std::array<double, size> element{};
    std::copy_n(values->values.begin() + static_cast<std::ptrdiff_t>(index * size), size, element.begin());
    return element;
}

// The transforms of the copies of a node's mesh in the node's space: one identity without
// EXT_mesh_gpu_instancing. Source: that extension.
std::vector<glm::dmat4> instances_of(const GltfDocument& document, const tinygltf::Node& node,
                                     const std::string& name) {
    const auto found = node.extensions.find("EXT_mesh_gpu_instancing");
    if (found == node.extensions.end() || !found->second.Has("attributes")) return {glm::dmat4(1.0)};
    const tinygltf::Value& list = found->second.Get("attributes");
    std::optional<std::size_t> count;
    const auto t = instance_attribute(document, list, "TRANSLATION", 3, name, count);
    const auto r = instance_attribute(document, list, "ROTATION", 4, name, count);
    const auto s = instance_attribute(document, list, "SCALE", 3, name, count);
    if (count.value_or(1) > document.limits.parts)
        throw MeshFault(fmt::format("over {} instances are not read", document.limits.parts));
    std::vector<glm::dmat4> instances;
    for (std::size_t i = 0; i < count.value_or(1); ++i) {
        const auto matrix = placement(element_or<3>(t, i, {0, 0, 0}), element_or<4>(r, i, {0, 0, 0, 1}),
                                      element_or<3>(s, i, {1, 1, 1}));
        if (!matrix) throw MeshFault(fmt::format("{}: the rotation of instance {} is zero", name, i));
        instances.push_back(*matrix);
    }
    return instances;
}

bool is_hidden(const tinygltf::Node& node) {
    const auto found = node.extensions.find("KHR_node_visibility");
    return found != node.extensions.end() && found->second.Has("visible") &&
           !found->second.Get("visible").Get<bool>();
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
    constexpr std::size_t kMaxShown = 8;
    const std::size_t count = model.scenes.size();
    std::string list;
    for (std::size_t i = 0; i < std::min(count, kMaxShown); ++i)
        list += fmt::format("{}{} {}", i == 0 ? "" : ", ", i, quoted_name(model.scenes[i].name));
    return list + (count > kMaxShown ? ", ..." : "");
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

PlacedNodes place_nodes(const GltfDocument& document, std::optional<std::size_t> scene, MeshNotes& notes) {
    const tinygltf::Model& model = document.model;
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
        if (is_hidden(node)) continue;  // and everything below it
        const std::string name = fmt::format("nodes[{}]", step.node);
        const glm::dmat4 matrix = step.parent * local_matrix(node, name);
        enter(children_of(model, step.node), matrix);
        if (const auto camera = checked_index(node.camera, model.cameras.size(), name + ".camera", "cameras"))
            place_camera(model.cameras[*camera], matrix, placed, notes);
        const auto mesh = checked_index(node.mesh, model.meshes.size(), name + ".mesh", "meshes");
        if (!mesh) continue;
        for (const glm::dmat4& instance : instances_of(document, node, name))
            placed.meshes.push_back({*mesh, matrix * instance});
        if (placed.meshes.size() > document.limits.parts)
            throw MeshFault(fmt::format("over {} parts of meshes are not read", document.limits.parts));
        if (node.skin != -1) ++notes["a skin is ignored: the mesh is read in its rest pose"];
    }
    return placed;
}

}  // namespace voxilux
