#include "scene/vox_instances.h"

#include <algorithm>

#include "base/checked_cast.h"
#include "scene/vox_graph.h"

namespace voxilux {
namespace {

// What a node does to everything below it at one frame.
struct Pose {
    Rotation rotation;
    glm::i64vec3 translation{0};
    bool hidden = false;
    std::int32_t layer = -1;
    std::uint32_t model = kVoxNoNode;  // of a shape
};

struct Step {
    std::uint32_t node = 0;
    std::uint32_t next_child = 0;
    Pose world;
    std::uint32_t transform = kVoxNoNode;
};

std::vector<std::int32_t> hidden_layers(const VoxFile& file) {
    std::vector<std::int32_t> ids;
    for (const VoxLayer& layer : file.layers) {
        if (is_flagged(layer.attributes, "_hidden")) ids.push_back(layer.id);
    }
    std::sort(ids.begin(), ids.end());
    return ids;
}

Result<Pose> pose_of(const VoxTransform& transform, const std::vector<std::int32_t>& hidden,
                     std::int64_t frame) {
    Pose pose{.hidden = std::binary_search(hidden.begin(), hidden.end(), transform.layer),
              .layer = transform.layer};
    if (transform.frames.empty()) return pose;
    std::vector<std::int64_t> frames;
    frames.reserve(transform.frames.size());
    for (const VoxDict& attributes : transform.frames) {
        const auto number = parse_frame(attributes);
        if (!number) return Failure{number.reason()};
        frames.push_back(number.value());
    }
    const bool loop = is_flagged(transform.attributes, "_loop");
    const auto key = parse_key(transform.frames[key_at(frames, frame, loop)]);
    if (!key) return Failure{key.reason()};
    pose.rotation = key.value().rotation;
    pose.translation = key.value().translation;
    return pose;
}

Result<Pose> pose_of(const VoxShape& shape, std::size_t models, std::int64_t frame) {
    Pose pose;
    if (shape.models.empty()) return pose;
    std::vector<std::int64_t> frames;
    frames.reserve(shape.models.size());
    for (const VoxShapeModel& model : shape.models) {
        const auto number = parse_frame(model.attributes);
        if (!number) return Failure{number.reason()};
        frames.push_back(number.value());
    }
    const std::int32_t model =
        shape.models[key_at(frames, frame, is_flagged(shape.attributes, "_loop"))].model;
    if (model >= 0 && static_cast<std::size_t>(model) < models)
        pose.model = static_cast<std::uint32_t>(model);
    return pose;
}

// The pose of each node of the graph, indexed by its position, so that the attributes of a node that is
// reached on many paths are read once.
Result<std::vector<Pose>> measure_poses(const VoxFile& file, const VoxGraph& graph, std::int64_t frame) {
    const std::vector<std::int32_t> hidden = hidden_layers(file);
    std::vector<Pose> poses(file.nodes.size());
    for (const std::uint32_t position : graph.order) {
        const VoxNode& node = file.nodes[position];
        Result<Pose> pose = Pose{};
        if (const auto* transform = std::get_if<VoxTransform>(&node))
            pose = pose_of(*transform, hidden, frame);
        if (const auto* shape = std::get_if<VoxShape>(&node))
            pose = pose_of(*shape, file.models.size(), frame);
        if (!pose) return Failure{fmt::format("node {}: {}", id_of(node), pose.reason())};
        poses[position] = pose.value();
        if (!std::holds_alternative<VoxShape>(node) && is_flagged(attributes_of(node), "_hidden"))
            poses[position].hidden = true;
    }
    return poses;
}

glm::i64vec3 turn(const Rotation& r, glm::i64vec3 v) {
    return {r.sign[0] * v[r.axis[0]], r.sign[1] * v[r.axis[1]], r.sign[2] * v[r.axis[2]]};
}

Pose below(const Pose& parent, const Pose& node) {
    return {.rotation = parent.rotation.after(node.rotation),
            .translation = turn(parent.rotation, node.translation) + parent.translation,
            .hidden = parent.hidden || node.hidden,
            .layer = parent.layer,
            .model = node.model};
}

// The step from `from` to the node at `position`.
Step enter(const VoxFile& file, const std::vector<Pose>& poses, std::uint32_t position, const Step& from) {
    Step step{.node = position, .world = below(from.world, poses[position]), .transform = from.transform};
    if (std::holds_alternative<VoxTransform>(file.nodes[position])) {
        step.transform = position;
        step.world.layer = poses[position].layer;
    }
    return step;
}

VoxInstance instance_at(const Step& step) {
    return {.model = step.world.model,
            .rotation = step.world.rotation,
            .translation = glm::ivec3(step.world.translation),
            .hidden = step.world.hidden,
            .layer = step.world.layer,
            .node = step.transform};
}

Result<std::vector<VoxInstance>> walk(const VoxFile& file, const VoxGraph& graph,
                                      const std::vector<Pose>& poses) {
    std::vector<VoxInstance> instances;
    instances.reserve(static_cast<std::size_t>(graph.instances));
    std::vector<Step> path;
    if (!graph.order.empty()) path.push_back(enter(file, poses, graph.order.front(), Step{}));
    while (!path.empty()) {
        Step& top = path.back();
        const auto children = children_of(file.nodes[top.node]);
        if (top.next_child < children.size()) {
            const std::uint32_t child = graph.position_of(children[top.next_child++]);
            if (child != kVoxNoNode) path.push_back(enter(file, poses, child, Step(top)));
            continue;
        }
        if (top.world.model != kVoxNoNode) {
            if (!is_vox_translation(top.world.translation)) {
                return Failure{fmt::format("node {}: its position is beyond {} voxels from the origin",
                                           id_of(file.nodes[top.node]), kVoxMaxTranslation)};
            }
            instances.push_back(instance_at(top));
        }
        path.pop_back();
    }
    return instances;
}

}  // namespace

std::size_t key_at(const std::vector<std::int64_t>& frames, std::int64_t frame, bool loop) {
    if (frames.empty()) return 0;
    const auto [first, last] = std::minmax_element(frames.begin(), frames.end());
    if (loop && frame > *last) frame = *first + (frame - *first) % (*last - *first + 1);
    std::size_t key = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (frames[i] <= frame) key = i;
    }
    return key;
}

std::vector<VoxInstance> corner_instances(const VoxFile& file) {
    std::vector<VoxInstance> instances;
    instances.reserve(file.models.size());
    for (std::size_t i = 0; i < file.models.size(); ++i) {
        instances.push_back(
            {.model = checked_cast<std::uint32_t>(i, "model"), .translation = file.models[i].size / 2});
    }
    return instances;
}

Result<std::vector<VoxInstance>> vox_instances(const VoxFile& file, std::int64_t frame) {
    if (!has_graph(file)) {
        std::vector<VoxInstance> all = corner_instances(file);
        if (!file.pack || all.empty()) return all;
        const auto count = static_cast<std::int64_t>(all.size());
        const std::int64_t shown = (frame % count + count) % count;
        return std::vector<VoxInstance>{all[static_cast<std::size_t>(shown)]};
    }
    auto built = build_graph(file);
    if (const auto* fault = std::get_if<VoxGraphFault>(&built)) {
        return Failure{fmt::format("node {}: {}", id_of(file.nodes[fault->node]), fault->rule)};
    }
    const auto& graph = std::get<VoxGraph>(built);
    const auto poses = measure_poses(file, graph, frame);
    if (!poses) return Failure{poses.reason()};
    return walk(file, graph, poses.value());
}

std::string_view instance_name(const VoxFile& file, const VoxInstance& instance) {
    if (instance.node >= file.nodes.size()) return {};
    const std::string* name = find_value(attributes_of(file.nodes[instance.node]), "_name");
    return name != nullptr ? std::string_view(*name) : std::string_view();
}

bool is_vox_translation(glm::i64vec3 t) {
    return std::max({std::abs(t.x), std::abs(t.y), std::abs(t.z)}) <= kVoxMaxTranslation;
}

}  // namespace voxilux
