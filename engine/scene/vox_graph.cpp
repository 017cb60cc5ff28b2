#include "scene/vox_graph.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/checked_cast.h"
#include "base/printable.h"

namespace voxilux {
namespace {

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r\n";
    const std::size_t begin = text.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

template <class T>
std::optional<T> parse_whole(std::string_view text) {
    text = trimmed(text);
    if (text.starts_with('+')) text.remove_prefix(1);
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

Result<glm::i64vec3> parse_translation(std::string_view text) {
    glm::i64vec3 translation{0};
    int axis = 0;
    for (std::string_view rest = trimmed(text); !rest.empty(); ++axis) {
        const std::size_t end = std::min(rest.find_first_of(" \t\r\n"), rest.size());
        const std::optional<double> value = parse_number(rest.substr(0, end));
        if (axis == 3 || !value)
            return Failure{fmt::format("translation {} is not three numbers", quoted_name(text))};
        if (!(std::abs(*value) <= static_cast<double>(kVoxMaxTranslation))) {
            return Failure{
                fmt::format("translation {} is beyond {} voxels", quoted_name(text), kVoxMaxTranslation)};
        }
        translation[axis] = static_cast<std::int64_t>(*value);  // towards zero
        rest = trimmed(rest.substr(end));
    }
    if (axis != 3) return Failure{fmt::format("translation {} is not three numbers", quoted_name(text))};
    return translation;
}

struct Visit {
    std::uint32_t node = 0;
    std::uint32_t next_child = 0;
};

enum class Mark : std::uint8_t { unseen, open, done };

// Depth-first from `root`; appends each node after its children. Returns the first node that is below itself.
std::uint32_t append_postorder(const VoxFile& file, const VoxGraph& graph, std::uint32_t root,
                               std::vector<std::uint32_t>& postorder) {
    std::vector<Mark> marks(file.nodes.size(), Mark::unseen);
    std::vector<Visit> path{{root, 0}};
    marks[root] = Mark::open;
    while (!path.empty()) {
        Visit& top = path.back();
        const auto children = children_of(file.nodes[top.node]);
        if (top.next_child == children.size()) {
            marks[top.node] = Mark::done;
            postorder.push_back(top.node);
            path.pop_back();
            continue;
        }
        const std::uint32_t child = graph.position_of(children[top.next_child++]);
        if (child == kVoxNoNode || marks[child] == Mark::done) continue;
        if (marks[child] == Mark::open) return child;
        marks[child] = Mark::open;
        path.push_back({child, 0});
    }
    return kVoxNoNode;
}

// Counts the paths from node 0 to each node, which tell the cost of a walk before anything is walked.
std::optional<VoxGraphFault> count_paths(const VoxFile& file, VoxGraph& graph) {
    std::vector<std::uint64_t> paths(file.nodes.size(), 0);
    if (!graph.order.empty()) paths[graph.order.front()] = 1;
    std::uint64_t visits = 0;
    for (const std::uint32_t node : graph.order) {
        visits += paths[node];
        if (visits > kVoxMaxVisits) {
            return VoxGraphFault{node,
                                 fmt::format("the scene graph expands to more than {} nodes", kVoxMaxVisits)};
        }
        if (std::holds_alternative<VoxShape>(file.nodes[node])) graph.instances += paths[node];
        if (graph.instances > kVoxMaxInstances) {
            return VoxGraphFault{node,
                                 fmt::format("the scene graph has more than {} instances", kVoxMaxInstances)};
        }
        for (const std::int32_t id : children_of(file.nodes[node])) {
            const std::uint32_t child = graph.position_of(id);
            // Below the limit here, so a sum over at most 2^32 children cannot wrap 64 bits.
            if (child != kVoxNoNode) paths[child] += paths[node];
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
    return parse_whole<double>(text);
}

std::optional<std::int64_t> parse_integer(std::string_view text) {
    return parse_whole<std::int64_t>(text);
}

bool is_flagged(const VoxDict& attributes, std::string_view key) {
    const std::string* value = find_value(attributes, key);
    return value != nullptr && *value == "1";
}

Result<std::int64_t> parse_frame(const VoxDict& attributes) {
    const std::string* text = find_value(attributes, "_f");
    if (text == nullptr || text->empty()) return std::int64_t{0};
    const auto frame = parse_integer(*text);
    if (!frame || !std::in_range<std::int32_t>(*frame))
        return Failure{fmt::format("frame {} is not a 32-bit integer", quoted_name(*text))};
    return *frame;
}

Result<Rotation> parse_rotation(std::string_view text) {
    const auto byte = parse_integer(text);
    if (!byte || *byte < 0 || *byte > 255)
        return Failure{fmt::format("rotation {} is not a byte", quoted_name(text))};
    const auto bits = static_cast<unsigned>(*byte);
    const unsigned first = bits & 3;
    const unsigned second = (bits >> 2) & 3;
    if (first == 3 || second == 3 || first == second) {
        return Failure{
            fmt::format("rotation {}: rows 1 and 2 name columns {} and {}, which must be two of 0, 1, 2",
                        bits, first, second)};
    }
    const auto sign = [&](unsigned bit) { return static_cast<std::int8_t>((bits >> bit & 1) != 0 ? -1 : 1); };
    return Rotation{.axis = {static_cast<std::uint8_t>(first), static_cast<std::uint8_t>(second),
                             static_cast<std::uint8_t>(3 - first - second)},
                    .sign = {sign(4), sign(5), sign(6)}};
}

Result<VoxKey> parse_key(const VoxDict& attributes) {
    VoxKey key;
    const auto frame = parse_frame(attributes);
    if (!frame) return Failure{frame.reason()};
    key.frame = frame.value();
    if (const std::string* text = find_value(attributes, "_r")) {
        const auto rotation = parse_rotation(*text);
        if (!rotation) return Failure{rotation.reason()};
        key.rotation = rotation.value();
    }
    if (const std::string* text = find_value(attributes, "_t")) {
        const auto translation = parse_translation(*text);
        if (!translation) return Failure{translation.reason()};
        key.translation = translation.value();
    }
    return key;
}

std::int32_t id_of(const VoxNode& node) {
    return std::visit([](const auto& n) { return n.id; }, node);
}

const VoxDict& attributes_of(const VoxNode& node) {
    return std::visit([](const auto& n) -> const VoxDict& { return n.attributes; }, node);
}

std::span<const std::int32_t> children_of(const VoxNode& node) {
    if (const auto* transform = std::get_if<VoxTransform>(&node)) return {&transform->child, 1};
    if (const auto* group = std::get_if<VoxGroup>(&node)) return group->children;
    return {};
}

bool has_graph(const VoxFile& file) {
    return std::any_of(file.nodes.begin(), file.nodes.end(),
                       [](const VoxNode& n) { return std::holds_alternative<VoxTransform>(n); });
}

std::uint32_t VoxGraph::position_of(std::int32_t id) const {
    const auto found = std::lower_bound(by_id.begin(), by_id.end(), std::pair{id, std::uint32_t{0}});
    return found != by_id.end() && found->first == id ? found->second : kVoxNoNode;
}

std::variant<VoxGraph, VoxGraphFault> build_graph(const VoxFile& file) {
    VoxGraph graph;
    const auto count = checked_cast<std::uint32_t>(file.nodes.size(), "nodes of a .vox file");
    graph.by_id.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i)
        graph.by_id.emplace_back(id_of(file.nodes[i]), i);
    std::sort(graph.by_id.begin(), graph.by_id.end());
    for (std::size_t i = 1; i < count; ++i) {
        if (graph.by_id[i - 1].first == graph.by_id[i].first) {
            return VoxGraphFault{graph.by_id[i].second,
                                 fmt::format("node id {} is used twice", graph.by_id[i].first)};
        }
    }
    const std::uint32_t root = graph.position_of(0);
    if (root == kVoxNoNode) return graph;
    const std::uint32_t cycle = append_postorder(file, graph, root, graph.order);
    if (cycle != kVoxNoNode) {
        return VoxGraphFault{cycle, fmt::format("node {} is below itself: the scene graph has a cycle",
                                                id_of(file.nodes[cycle]))};
    }
    std::reverse(graph.order.begin(), graph.order.end());
    if (auto fault = count_paths(file, graph)) return std::move(*fault);
    return graph;
}

}  // namespace voxilux
