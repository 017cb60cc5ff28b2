#include "scene/vox_animation.h"

#include <algorithm>
#include <optional>

#include "scene/vox_graph.h"

namespace voxilux {
namespace {

bool is_pack(const VoxFile& file) {
    return file.pack && !has_graph(file) && file.models.size() > 1;
}

bool has_several_keys(const VoxNode& node) {
    if (const auto* transform = std::get_if<VoxTransform>(&node)) return transform->frames.size() > 1;
    if (const auto* shape = std::get_if<VoxShape>(&node)) return shape->models.size() > 1;
    return false;
}

// read_vox has checked every key of a file that was read. An invalid one, in a file that a program has made,
// counts as 0.
void append_frame(const VoxDict& attributes, std::vector<std::int64_t>& frames) {
    const auto frame = parse_frame(attributes);
    frames.push_back(std::clamp<std::int64_t>(frame ? frame.value() : 0, 0, kMaxFrame));
}

// Of the nodes that change, rising, each once. Never empty for an animated file.
std::vector<std::int64_t> all_key_frames(const VoxFile& file) {
    std::vector<std::int64_t> frames;
    if (is_pack(file)) {
        for (std::size_t i = 0; i < file.models.size(); ++i)
            frames.push_back(std::min(static_cast<std::int64_t>(i), kMaxFrame));
    }
    for (const VoxNode& node : file.nodes) {
        if (!has_several_keys(node)) continue;
        if (const auto* transform = std::get_if<VoxTransform>(&node)) {
            for (const VoxDict& key : transform->frames)
                append_frame(key, frames);
        } else {
            for (const VoxShapeModel& model : std::get<VoxShape>(node).models)
                append_frame(model.attributes, frames);
        }
    }
    std::ranges::sort(frames);
    frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
    return frames;
}

// META's "_anim_range": "0 30".
std::optional<FrameRange> stated_range(const VoxFile& file) {
    const std::string* text = file.meta ? find_value(*file.meta, "_anim_range") : nullptr;
    if (text == nullptr) return std::nullopt;
    const std::size_t blank = std::min(text->find(' '), text->size());
    const auto first = parse_integer(std::string_view(*text).substr(0, blank));
    const auto last = parse_integer(std::string_view(*text).substr(blank));
    if (!first || !last || *first < 0 || *last < *first || *last > kMaxFrame) return std::nullopt;
    return FrameRange{*first, *last};
}

}  // namespace

bool is_animated(const VoxFile& file) {
    if (!has_graph(file)) return is_pack(file);
    return std::ranges::any_of(file.nodes, has_several_keys);
}

FrameRange frames_of(const VoxFile& file) {
    if (const auto stated = stated_range(file)) return *stated;
    const std::vector<std::int64_t> keys = all_key_frames(file);
    return keys.empty() ? FrameRange{} : FrameRange{keys.front(), keys.back()};
}

std::vector<std::int64_t> key_frames_of(const VoxFile& file) {
    const FrameRange range = frames_of(file);
    std::vector<std::int64_t> keys = all_key_frames(file);
    std::erase_if(keys, [&](std::int64_t key) { return key < range.first || key > range.last; });
    return keys;
}

VoxFile graph_of(const VoxFile& file) {
    VoxFile graph{.version = file.version, .pack = file.pack};
    graph.models.reserve(file.models.size());
    for (const VoxModel& model : file.models)
        graph.models.push_back({.size = model.size});
    graph.nodes = file.nodes;
    graph.layers = file.layers;
    graph.meta = file.meta;
    return graph;
}

}  // namespace voxilux
