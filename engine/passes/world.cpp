#include "passes/world.h"

#include <algorithm>

#include "base/checked_cast.h"
#include "shared/aadf.h"
#include "shared/gpu_types.h"
#include "world/build_fields.h"

namespace voxilux {
namespace {

void upload_words(const std::string& buffer, const std::vector<std::uint32_t>& words, Recording& recording) {
    if (!words.empty()) recording.upload(buffer, std::as_bytes(std::span(words)));
}

std::string& level_buffer(WorldBuffers& buffers, const MarchWorld& world, int log2) {
    if (log2 == gpu::root_log2(static_cast<gpu::uint>(world.traversal))) return buffers.roots;
    return log2 == gpu::kBrickLog2 ? buffers.nodes : buffers.leaves;
}

// Steps alternate between the level's buffer and the scratch. Their number is odd, so a level that starts in
// the scratch ends in its own buffer.
static_assert(gpu::kAadfSteps % 2 == 1);

void record_growth(const MarchWorld& skeleton, int log2, const WorldBuffers& buffers, Recording& recording) {
    gpu::WorldGrowPush push{.count = checked_cast<gpu::uint>(level_cells(skeleton, log2).size(), "cells"),
                            .chunks = skeleton.chunks_size,
                            .log2 = static_cast<gpu::uint>(log2)};
    WorldBuffers read = buffers;
    std::string& source = level_buffer(read, skeleton, log2);
    std::string target = source;
    source = buffers.grown;
    for (gpu::uint step = 0; step < gpu::kAadfSteps; ++step) {
        push.axis = step % 3;
        push.bound = gpu::aadf_bound(step / 3);
        recording.dispatch({.label = "world.grow",
                            .shader = "world_grow",
                            .extent = {push.count, 1, 1},
                            .bindings = {{"Roots", read.roots},
                                         {"Nodes", read.nodes},
                                         {"Leaves", read.leaves},
                                         {"Homes", buffers.homes},
                                         {"Grown", target}},
                            .constants = {{"traversal", static_cast<std::uint32_t>(skeleton.traversal)}},
                            .push = to_bytes(push)});
        std::swap(source, target);
    }
}

}  // namespace

void record_world_build(const MarchWorld& skeleton, const WorldBuffers& buffers, Recording& recording) {
    const std::vector<int> levels = far_levels(skeleton.traversal);
    const int root = gpu::root_log2(static_cast<gpu::uint>(skeleton.traversal));
    const auto grows = [&](int log2) { return std::ranges::find(levels, log2) != levels.end(); };
    if (!grows(root)) upload_words(buffers.roots, skeleton.roots, recording);
    if (!grows(gpu::kBrickLog2) || root == gpu::kBrickLog2)
        upload_words(buffers.nodes, skeleton.nodes, recording);
    if (!grows(0)) upload_words(buffers.leaves, skeleton.leaves, recording);
    for (const int log2 : levels) {
        if (level_cells(skeleton, log2).empty()) continue;
        upload_words(buffers.grown, level_cells(skeleton, log2), recording);
        if (log2 != root) upload_words(buffers.homes, level_homes(skeleton, log2), recording);
        record_growth(skeleton, log2, buffers, recording);
    }
}

}  // namespace voxilux
