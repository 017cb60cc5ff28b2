#include "passes/world.h"

#include <algorithm>

#include "base/checked_cast.h"
#include "shared/gpu_types.h"
#include "world/world_view.h"

namespace voxilux {
namespace {

void upload_words(const std::string& buffer, const std::vector<std::uint32_t>& words, Recording& recording) {
    recording.upload(buffer, std::as_bytes(std::span(words)));
}

std::string& level_buffer(WorldBuffers& buffers, const MarchWorld& world, int log2) {
    return log2 == gpu::root_log2(static_cast<gpu::uint>(world.traversal)) ? buffers.roots : buffers.nodes;
}

const std::string& texels_of(const std::string& array, const WorldBuffers& buffers) {
    return buffers.have_texels ? array : buffers.unused;
}

// Binds all arrays but the leaves as texels.
void point_to_cells(Traversal traversal, const WorldBuffers& buffers, Dispatch& dispatch) {
    dispatch.addresses.insert(
        dispatch.addresses.end(),
        {{"roots", buffers.roots}, {"nodes", buffers.nodes}, {"leaves", buffers.leaves}});
    dispatch.bindings.insert(dispatch.bindings.end(), {{"Roots", texels_of(buffers.roots, buffers)},
                                                       {"Nodes", texels_of(buffers.nodes, buffers)}});
    dispatch.constants.insert(dispatch.constants.end(),
                              {{"traversal", static_cast<std::uint32_t>(traversal)},
                               {"has_world_texels", buffers.have_texels ? 1u : 0u}});
}

// Steps alternate between the level's own buffer and the scratch. Their number is odd: a level that starts in
// the scratch ends in its own buffer.
static_assert(gpu::kGrowthSteps % 2 == 1);

void record_growth(const MarchWorld& unexpanded, const GrowingLevel& level, const WorldBuffers& buffers,
                   Recording& recording) {
    const int log2 = level.log2;
    gpu::WorldGrowPush push{.count = checked_cast<gpu::uint>(level.cells, "cells"),
                            .chunks = unexpanded.chunks_size};
    WorldBuffers read = buffers;
    std::string& source = level_buffer(read, unexpanded, log2);
    std::string target = buffers.grown;
    std::swap(source, target);
    upload_words(source, level_words(unexpanded, log2), recording);
    for (gpu::uint number = 0; number < gpu::kGrowthSteps; ++number) {
        const gpu::GrowthStep step = gpu::growth_step(number);
        push.axis = step.axis;
        push.bound = step.bound;
        Dispatch dispatch{.label = "world.grow",
                          .shader = "world_grow",
                          .extent = {push.count, 1, 1},
                          .bindings = {{"Homes", buffers.homes}},
                          .addresses = {{"grown", target}},
                          .constants = {{"level", static_cast<std::uint32_t>(log2)}},
                          .push = to_bytes(push)};
        point_to_cells(unexpanded.traversal, read, dispatch);
        recording.dispatch(std::move(dispatch));
        std::swap(source, target);
    }
}

void upload_ranges(const std::string& buffer, const std::vector<std::uint32_t>& words,
                   std::span<const WordRange> ranges, Recording& recording) {
    for (const WordRange& range : ranges) {
        const auto changed = std::span(words).subspan(range.first, range.end - range.first);
        recording.upload(buffer, std::as_bytes(changed), sizeof(std::uint32_t) * range.first);
    }
}

}  // namespace

void point_to_world(Traversal traversal, const WorldBuffers& buffers, Dispatch& dispatch) {
    point_to_cells(traversal, buffers, dispatch);
    dispatch.bindings.push_back({"Leaves", texels_of(buffers.leaves, buffers)});
}

void record_world_build(const MarchWorld& unexpanded, const GrowthNeeds& growth, const WorldBuffers& buffers,
                        Recording& recording) {
    const int root = gpu::root_log2(static_cast<gpu::uint>(unexpanded.traversal));
    const auto grows = [&](int log2) {
        return std::ranges::find(growth.levels, log2, &GrowingLevel::log2) != growth.levels.end();
    };
    if (!grows(root)) upload_words(buffers.roots, unexpanded.roots, recording);
    if (root == gpu::kBrickLog2 || !grows(gpu::kBrickLog2))
        upload_words(buffers.nodes, unexpanded.nodes, recording);
    upload_words(buffers.leaves, unexpanded.leaves, recording);
    for (const GrowingLevel& level : growth.levels) {
        const std::vector<glm::ivec3> homes = level_homes(unexpanded, level.log2);
        recording.upload(buffers.homes, std::as_bytes(std::span(homes)));
        record_growth(unexpanded, level, buffers, recording);
    }
}

void record_world_edit(const MarchWorld& built, const WorldChanges& changes, const WorldBuffers& buffers,
                       Recording& recording) {
    VX_ASSERT(!changes.is_rebuilt);
    upload_ranges(buffers.roots, built.roots, changes.roots, recording);
    upload_ranges(buffers.nodes, built.nodes, changes.nodes, recording);
    upload_ranges(buffers.leaves, built.leaves, changes.leaves, recording);
}

}  // namespace voxilux
