#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/error.h"
#include "scene/scene.h"
#include "scene/vox_file.h"

// What the attributes and the links of a .vox scene graph mean. Used by the reader, which checks them once,
// and by everything that walks the graph.
namespace voxilux {

inline constexpr std::uint32_t kVoxNoNode = 0xFFFFFFFF;

// The nodes that are reached from node 0, as positions in VoxFile::nodes. A node may have several parents.
struct VoxGraph {
    std::vector<std::pair<std::int32_t, std::uint32_t>> by_id;  // (id, position), sorted
    std::vector<std::uint32_t> order;                           // each once, parents before children
    std::uint64_t instances = 0;                                // paths from node 0 to a shape

    // The position of the node with this id, or kVoxNoNode.
    [[nodiscard]] std::uint32_t position_of(std::int32_t id) const;
};

struct VoxGraphFault {
    std::uint32_t node = 0;  // position of the offending node
    std::string rule;
};

// The graph, or why it cannot be walked: ids that repeat, a cycle, more instances or visits than the limits
// allow. Iterative: its depth is bounded by nothing but the number of nodes.
[[nodiscard]] std::variant<VoxGraph, VoxGraphFault> build_graph(const VoxFile& file);

// A graph needs a transform; shapes and groups alone are ignored, as by other readers.
[[nodiscard]] bool has_graph(const VoxFile& file);

[[nodiscard]] std::int32_t id_of(const VoxNode& node);
[[nodiscard]] const VoxDict& attributes_of(const VoxNode& node);
// The ids of its children. Valid as long as `node`.
[[nodiscard]] std::span<const std::int32_t> children_of(const VoxNode& node);

struct VoxKey {
    std::int64_t frame = 0;
    Rotation rotation;
    glm::i64vec3 translation{0};  // |component| <= kVoxMaxTranslation
};

// The meaning of a frame's attributes _f, _r, _t; what is absent is 0, the identity, 0.
[[nodiscard]] Result<VoxKey> parse_key(const VoxDict& attributes);
// Only _f: a 32-bit integer.
[[nodiscard]] Result<std::int64_t> parse_frame(const VoxDict& attributes);
// A rotation byte: bits 0-1 and 2-3 are the column of the first two rows, bits 4-6 the signs of the three
// rows.
[[nodiscard]] Result<Rotation> parse_rotation(std::string_view text);

[[nodiscard]] bool is_flagged(const VoxDict& attributes, std::string_view key);  // the value is "1"

// The whole of `text` (blanks around it allowed) as a number in C notation, or nothing. Infinities and NaN
// are returned, too.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view text);

}  // namespace voxilux
