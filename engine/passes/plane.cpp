#include "passes/plane.h"

#include <algorithm>
#include <bit>

#include "shared/gpu_types.h"
#include "shared/sequence.h"

namespace voxilux {

std::string use_buffer(const RenderPlan& plan, const std::string& name, Recording& recording) {
    const auto planned = std::ranges::find(plan.buffers, name, &PlannedBuffer::buffer);
    if (planned == plan.buffers.end())
        throw InternalError(fmt::format("internal error: the plan has no buffer '{}'", name));
    recording.declare({.name = name, .size_bytes = planned->bytes, .persistent = planned->persistent});
    return name;
}

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

std::string use_or_placeholder(const RenderPlan& plan, bool on, const std::string& name,
                               Recording& recording) {
    if (on) return use_buffer(plan, name, recording);
    return placeholder_buffer(recording);
}

}  // namespace

std::string placeholder_buffer(Recording& recording) {
    return use_constant("constant.placeholder", sizeof(std::uint32_t), 0, recording);
}

Plane constant_miss(Recording& recording) {
    return {use_constant("constant.miss", sizeof(gpu::Hit), 0xFFFFFFFFu, recording), 0};
}

Plane constant_value(float value, Recording& recording, std::uint32_t components) {
    const std::string name = components == 1 ? fmt::format("constant.{}", value)
                                             : fmt::format("constant.{}x{}", value, components);
    return {use_constant(name, components * sizeof(float), std::bit_cast<std::uint32_t>(value), recording),
            0};
}

Extent pixel_extent(const RenderPlan& plan, const Slice& slice) {
    return {static_cast<std::uint32_t>(plan.settings.size.x), slice.row_count, 1};
}

std::string materials_buffer(const RenderPlan& plan, Recording& recording) {
    const bool traced = plan.has(Effect::voxels) || plan.has(Effect::spheres);
    return use_or_placeholder(plan, traced, "materials", recording);
}

std::string spheres_buffer(const RenderPlan& plan, Recording& recording) {
    return use_or_placeholder(plan, plan.has(Effect::spheres), "sphere.records", recording);
}

std::string sphere_table_buffer(const RenderPlan& plan, Recording& recording) {
    if (plan.has(Effect::spheres)) return use_buffer(plan, "sphere.records", recording);
    return use_constant("constant.spheres", gpu::kFewSpheres * sizeof(gpu::SphereRecord), 0, recording);
}

WorldBuffers world_buffers(const RenderPlan& plan, Recording& recording) {
    const bool on = plan.has(Effect::voxels);
    return {.roots = use_or_placeholder(plan, on, "world.roots", recording),
            .nodes = use_or_placeholder(plan, on, "world.nodes", recording),
            .leaves = use_or_placeholder(plan, on, "world.leaves", recording)};
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

std::vector<Constant> sphere_constants(const RenderPlan& plan) {
    return {{"sphere_count", plan.has(Effect::spheres) ? plan.sphere_count : 0u},
            {"glass_spheres", plan.has(Effect::specular) ? plan.glass_spheres : 0u}};
}

std::vector<Constant> surface_constants(const RenderPlan& plan) {
    std::vector<Constant> constants = sphere_constants(plan);
    constants.push_back({"has_voxels", plan.has(Effect::voxels) ? 1u : 0u});
    constants.push_back(sequence_constant(plan));
    return constants;
}

Plane record_surface_pass(const RenderPlan& plan, const Slice& slice, const SurfacePass& pass,
                          const Plane& hits, Recording& recording) {
    const Plane output{use_buffer(plan, pass.output_buffer, recording)};
    Dispatch dispatch{.label = pass.label,
                      .shader = pass.shader,
                      .extent = pixel_extent(plan, slice),
                      .bindings = {{"Frame", use_buffer(plan, "frame", recording)},
                                   {"Tally", use_buffer(plan, "tally", recording)},
                                   {"Spheres", spheres_buffer(plan, recording)},
                                   {"SphereTable", sphere_table_buffer(plan, recording)},
                                   {"Hits", hits.buffer},
                                   {pass.output_block, output.buffer}},
                      .constants = surface_constants(plan)};
    dispatch.constants.insert(dispatch.constants.end(), pass.constants.begin(), pass.constants.end());
    point_to_world(plan.world.traversal, world_buffers(plan, recording), dispatch);
    recording.dispatch(std::move(dispatch));
    return output;
}

}  // namespace voxilux
