#include "passes/plane.h"

#include <algorithm>
#include <bit>

#include "shared/alias.h"
#include "shared/counters.h"
#include "shared/gpu_types.h"
#include "shared/projection.h"
#include "shared/sequence.h"
#include "shared/sky_view.h"

namespace voxilux {

namespace {

// Declares a buffer of constants and fills it the first time it is used in a recording.
std::string use_constant(const std::string& name, std::uint64_t size_bytes, std::uint32_t word,
                         Recording& recording) {
    if (recording.find(name) == nullptr) {
        recording.declare({.name = name, .size_bytes = size_bytes});
        recording.clear(name, word);
    }
    return name;
}

}  // namespace

std::string placeholder_buffer(Recording& recording) {
    return use_constant("constant.placeholder", sizeof(gpu::SurfaceMaterial), 0, recording);
}

std::string constant_sky_buffer(Recording& recording) {
    return use_constant("constant.sky", sizeof(gpu::SkyParams), 0, recording);
}

Plane constant_miss(Recording& recording) {
    return {use_constant("constant.miss", sizeof(gpu::Hit), 0xFFFFFFFFu, recording), 0};
}

Plane constant_value(float value, Recording& recording) {
    return {use_constant(fmt::format("constant.{}", value), sizeof(gpu::vec4),
                         std::bit_cast<std::uint32_t>(value), recording),
            0};
}

std::string frame_buffer(Recording& recording) {
    return declare<gpu::FrameParams>(recording, "frame", 1);
}

std::string counters_buffer(Recording& recording) {
    return declare<gpu::uint>(recording, "counters", gpu::kCounterCount);
}

Extent pixel_extent(const RenderPlan& plan, const DispatchTile& tile) {
    return {static_cast<std::uint32_t>(plan.settings.size.x), tile.row_count, 1};
}

std::string materials_buffer(const RenderPlan& plan, Recording& recording) {
    if (!plan.has(Effect::voxels) && !plan.has(Effect::spheres)) return placeholder_buffer(recording);
    return declare<gpu::SurfaceMaterial>(recording, "materials", plan.material_count, Lifetime::persistent);
}

std::string spheres_buffer(const RenderPlan& plan, Recording& recording) {
    if (!plan.has(Effect::spheres)) return placeholder_buffer(recording);
    return declare<gpu::SphereRecord>(recording, "sphere.records",
                                      std::max(plan.sphere_count, gpu::kFewSpheres), Lifetime::persistent);
}

std::string sphere_table_buffer(const RenderPlan& plan, Recording& recording) {
    if (plan.has(Effect::spheres)) return spheres_buffer(plan, recording);
    return use_constant("constant.spheres", gpu::kFewSpheres * sizeof(gpu::SphereRecord), 0, recording);
}

std::string sphere_tree_buffer(const RenderPlan& plan, Recording& recording) {
    if (!plan.has_sphere_tree()) return placeholder_buffer(recording);
    return declare<gpu::SphereNode>(recording, "sphere.tree", plan.world.sphere_nodes, Lifetime::persistent);
}

std::string gains_buffer(const RenderPlan& plan, Recording& recording) {
    if (!plan.shows_rough) return placeholder_buffer(recording);
    return declare<float>(recording, "rough.gains", gpu::kGainPlaces * plan.gain_rows.size(),
                          Lifetime::persistent);
}

std::string lights_buffer(const RenderPlan& plan, Recording& recording) {
    return declare<gpu::LightRecord>(recording, "light.records", plan.world.lights.count,
                                     Lifetime::persistent);
}

std::string light_table_buffer(const RenderPlan& plan, Recording& recording) {
    return declare<gpu::AliasEntry>(recording, "light.table", plan.world.lights.count, Lifetime::persistent);
}

WorldBuffers world_buffers(const RenderPlan& plan, Recording& recording) {
    const auto array = [&](const char* name, std::uint64_t bytes) {
        if (!plan.has(Effect::voxels)) return placeholder_buffer(recording);
        return declare<std::byte>(recording, name, bytes, Lifetime::persistent);
    };
    return {.roots = array("world.roots", plan.world.root_bytes),
            .nodes = array("world.nodes", plan.world.node_bytes),
            .leaves = array("world.leaves", plan.world.leaf_bytes),
            .have_texels = plan.has_world_texels,
            .unused = placeholder_buffer(recording)};
}

gpu::uint sequence_id(Sequence sequence) {
    switch (sequence) {
        case Sequence::sobol:
            return gpu::kSequenceSobol;
        case Sequence::halton:
            return gpu::kSequenceHalton;
        case Sequence::white:
            return gpu::kSequenceWhite;
    }
    VX_ASSERT(false);
}

Constant sequence_constant(const RenderPlan& plan) {
    return {"sequence", sequence_id(plan.settings.sequence)};
}

Constant projection_constant(const RenderPlan& plan) {
    return {"projection",
            plan.has(Effect::lens) ? gpu::kThinLens : static_cast<std::uint32_t>(plan.projection)};
}

std::vector<Constant> sphere_constants(const RenderPlan& plan) {
    return {{"sphere_count", plan.has(Effect::spheres) ? plan.sphere_count : 0u},
            {"glass_spheres", plan.has(Effect::specular) ? plan.glass_spheres : 0u},
            {"has_ground", plan.has(Effect::spheres) && plan.has_ground ? 1u : 0u}};
}

std::vector<Constant> surface_constants(const RenderPlan& plan) {
    std::vector<Constant> constants = sphere_constants(plan);
    constants.push_back({"has_voxels", plan.has(Effect::voxels) ? 1u : 0u});
    constants.push_back(sequence_constant(plan));
    constants.push_back(projection_constant(plan));
    return constants;
}

Plane record_surface_pass(const RenderPlan& plan, const DispatchTile& tile, const SurfacePass& pass,
                          const Plane& hits, Recording& recording) {
    const Plane output{declare_plane<float>(plan, pass.output_buffer, recording)};
    Dispatch dispatch{.label = pass.label,
                      .shader = pass.shader,
                      .extent = pixel_extent(plan, tile),
                      .bindings = {{"Frame", frame_buffer(recording)},
                                   {"Counters", counters_buffer(recording)},
                                   {"Spheres", spheres_buffer(plan, recording)},
                                   {"SphereTable", sphere_table_buffer(plan, recording)},
                                   {"SphereTree", sphere_tree_buffer(plan, recording)},
                                   {"Hits", hits.buffer},
                                   {pass.output_block, output.buffer}},
                      .constants = surface_constants(plan)};
    dispatch.constants.insert(dispatch.constants.end(), pass.constants.begin(), pass.constants.end());
    point_to_world(plan.world.traversal, world_buffers(plan, recording), dispatch);
    recording.dispatch(std::move(dispatch));
    return output;
}

}  // namespace voxilux
