#include "passes/ao/ao.h"

#include <algorithm>

#include "shared/cell_age.h"
#include "shared/gpu_types.h"
#include "shared/limits.h"

namespace voxilux {
namespace {

// The table is swept whole, once in this many frames: often compared with kCellMaxAge, so that cells are
// released soon after they expire. If it were swept in parts, the frame in which a cell is released would
// depend on its slot, and the slot depends on the order of threads.
constexpr std::uint64_t kSweepFrames = 8;

std::uint32_t flag(bool on) {
    return on ? 1u : 0u;
}

// An array of the table: 64 bits for each slot.
std::string table_array(const RenderPlan& plan, const char* name, Recording& recording) {
    return declare<std::uint64_t>(recording, name, plan.ao.slots, Lifetime::persistent);
}

std::string touched_buffer(const RenderPlan& plan, Recording& recording) {
    return declare<gpu::uint>(recording, "ao.touched", plan.ao.slots, Lifetime::persistent);
}

// The number of hits that reprojection misses, followed by their list.
std::string missed_buffer(const RenderPlan& plan, Recording& recording) {
    return declare<std::byte>(recording, "ao.missed",
                              sizeof(gpu::AoMissed) + plan.tile_pixels() * sizeof(gpu::uint));
}

// The slots of the pixels of this sample and, with reprojection, of the previous one. The two buffers
// alternate.
struct SlotPlanes {
    std::string now;
    std::string last;
};

SlotPlanes slot_planes(const RenderPlan& plan, const gpu::AoParams& params, Recording& recording) {
    if (!plan.ao.reprojects)
        return {declare_plane<gpu::uint>(plan, "ao.slots_even", recording, Lifetime::persistent),
                placeholder_buffer(recording)};
    SlotPlanes planes{declare_plane<gpu::uint>(plan, "ao.slots_even", recording, Lifetime::persistent),
                      declare_plane<gpu::uint>(plan, "ao.slots_odd", recording, Lifetime::persistent)};
    if (params.pass_number % 2 == 1) std::swap(planes.now, planes.last);
    return planes;
}

// The bindings of every pass that finds cells.
std::vector<Binding> table_bindings(const RenderPlan& plan, const Plane& hits, const std::string& slots,
                                    Recording& recording) {
    return {{"Frame", frame_buffer(recording)},
            {"Counters", counters_buffer(recording)},
            {"AoFrame", declare<gpu::AoParams>(recording, "ao.frame", 1)},
            {"Keys", table_array(plan, "ao.keys", recording)},
            {"Samples", table_array(plan, "ao.samples", recording)},
            {"Touched", touched_buffer(plan, recording)},
            {"Hits", hits.buffer},
            {"Slots", slots}};
}

Constant rays_constant(const RenderPlan& plan) {
    return {"ao_rays", plan.settings.ao_rays};
}

std::vector<Constant> rest_constants(const RenderPlan& plan) {
    const AoSettings& ao = plan.settings.ao;
    return {{"checkerboard", flag(ao.checkerboard)}, {"has_limit", flag(ao.sample_limit != 0)}};
}

void record_ao_age(const RenderPlan& plan, Recording& recording) {
    recording.dispatch({.label = "ao.age",
                        .shader = "ao_age",
                        .extent = {plan.ao.slots, 1, 1},
                        .bindings = {{"Counters", counters_buffer(recording)},
                                     {"AoFrame", declare<gpu::AoParams>(recording, "ao.frame", 1)},
                                     {"Keys", table_array(plan, "ao.keys", recording)},
                                     {"Samples", table_array(plan, "ao.samples", recording)},
                                     {"Opens", table_array(plan, "ao.unoccluded", recording)},
                                     {"Touched", touched_buffer(plan, recording)}}});
}

void record_ao_lookup(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                      const SlotPlanes& planes, Recording& recording) {
    recording.dispatch({.label = "ao.lookup",
                        .shader = "ao_lookup",
                        .extent = pixel_extent(plan, tile),
                        .bindings = table_bindings(plan, hits, planes.now, recording),
                        .constants = rest_constants(plan)});
}

void record_ao_reproject(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                         const SlotPlanes& planes, Recording& recording) {
    const std::string missed = missed_buffer(plan, recording);
    recording.upload(missed, to_bytes(gpu::AoMissed{.groups_y = 1, .groups_z = 1}));
    Dispatch dispatch{.label = "ao.reproject",
                      .shader = "ao_reproject",
                      .extent = pixel_extent(plan, tile),
                      .bindings = table_bindings(plan, hits, planes.now, recording),
                      .constants = rest_constants(plan)};
    dispatch.bindings.insert(dispatch.bindings.end(), {{"LastSlots", planes.last}, {"Missed", missed}});
    recording.dispatch(std::move(dispatch));
}

void record_ao_search(const RenderPlan& plan, const Plane& hits, const SlotPlanes& planes,
                      Recording& recording) {
    const std::string missed = missed_buffer(plan, recording);
    Dispatch dispatch{.label = "ao.search",
                      .shader = "ao_search",
                      .bindings = table_bindings(plan, hits, planes.now, recording),
                      .constants = rest_constants(plan)};
    dispatch.bindings.push_back({"Missed", missed});
    recording.dispatch_indirect(std::move(dispatch), missed);
}

// Finds the slot of each hit, unless ao.sample does so itself.
void record_slots(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                  const SlotPlanes& planes, Recording& recording) {
    if (plan.ao.merged) return;
    if (!plan.ao.reprojects) return record_ao_lookup(plan, tile, hits, planes, recording);
    record_ao_reproject(plan, tile, hits, planes, recording);
    record_ao_search(plan, hits, planes, recording);
}

void record_ao_sample(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                      const SlotPlanes& planes, Recording& recording) {
    const bool merged = plan.ao.merged;
    // ao.sample reads the slots where another pass found them, else it writes them itself.
    const std::string unused = placeholder_buffer(recording);
    Dispatch dispatch{.label = "ao.sample",
                      .shader = "ao_sample",
                      .extent = pixel_extent(plan, tile),
                      .bindings = table_bindings(plan, hits, merged ? planes.now : unused, recording),
                      .constants = surface_constants(plan)};
    dispatch.bindings.insert(dispatch.bindings.end(),
                             {{"LastSlots", planes.last},
                              {"Spheres", spheres_buffer(plan, recording)},
                              {"SphereTable", sphere_table_buffer(plan, recording)},
                              {"SphereTree", sphere_tree_buffer(plan, recording)},
                              {"Opens", table_array(plan, "ao.unoccluded", recording)},
                              {"Located", merged ? unused : planes.now},
                              {"Own", declare_plane<float>(plan, "ao.own", recording)}});
    dispatch.constants.insert(dispatch.constants.end(), {{"reprojects", flag(plan.ao.reprojects)},
                                                         {"merged", flag(merged)},
                                                         {"by_pixel", flag(plan.settings.ao.by_pixel)},
                                                         rays_constant(plan)});
    point_to_world(plan.world.traversal, world_buffers(plan, recording), dispatch);
    recording.dispatch(std::move(dispatch));
}

// Ambient visibility and, for the filter, its variance.
struct Resolved {
    std::string visibility;
    std::string variance;
};

Resolved record_ao_resolve(const RenderPlan& plan, const DispatchTile& tile, const SlotPlanes& planes,
                           Recording& recording) {
    const bool filters = plan.settings.ao.filter > 0;
    Resolved resolved{
        declare_plane<float>(plan, "ao.visibility", recording),
        filters ? declare_plane<float>(plan, "ao.variance", recording) : placeholder_buffer(recording)};
    recording.dispatch({.label = "ao.resolve",
                        .shader = "ao_resolve",
                        .extent = pixel_extent(plan, tile),
                        .bindings = {{"Frame", frame_buffer(recording)},
                                     {"Slots", planes.now},
                                     {"Samples", table_array(plan, "ao.samples", recording)},
                                     {"Opens", table_array(plan, "ao.unoccluded", recording)},
                                     {"Own", declare_plane<float>(plan, "ao.own", recording)},
                                     {"Ao", resolved.visibility},
                                     {"Variance", resolved.variance}},
                        .constants = {{"wants_variance", flag(filters)}, rays_constant(plan)}});
    return resolved;
}

Plane record_ao_filter(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits, Resolved resolved,
                       Recording& recording) {
    Resolved filtered{declare_plane<float>(plan, "ao.filtered", recording),
                      declare_plane<float>(plan, "ao.filtered_variance", recording)};
    for (std::uint32_t i = 0; i < plan.settings.ao.filter; ++i) {
        recording.dispatch({.label = "ao.filter",
                            .shader = "ao_filter",
                            .extent = pixel_extent(plan, tile),
                            .bindings = {{"Frame", frame_buffer(recording)},
                                         {"Hits", hits.buffer},
                                         {"Ao", resolved.visibility},
                                         {"Variance", resolved.variance},
                                         {"FilteredAo", filtered.visibility},
                                         {"FilteredVariance", filtered.variance}},
                            .constants = {projection_constant(plan)},
                            .push = to_bytes(gpu::AoFilterPush{1 << i})});
        std::swap(resolved, filtered);
    }
    return {resolved.visibility};
}

void empty_table(const RenderPlan& plan, Recording& recording) {
    for (const char* array : {"ao.keys", "ao.samples", "ao.unoccluded"})
        recording.clear(table_array(plan, array, recording));
}

}  // namespace

SeenCells seen_cells(const RenderPlan& plan, std::uint64_t sample, Recording& recording) {
    const gpu::AoParams params{.pass_number = static_cast<gpu::uint>(sample)};
    return {slot_planes(plan, params, recording).now, table_array(plan, "ao.samples", recording)};
}

Plane record_ao_trace(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits,
                      Recording& recording) {
    return record_surface_pass(
        plan, tile, {"ao.trace", "ao_trace", "Ao", "ao.visibility", {rays_constant(plan)}}, hits, recording);
}

std::uint32_t cell_age(const RenderPlan& plan, std::uint64_t live_cells) {
    const std::uint64_t room = plan.ao.slots / 4;
    if (live_cells <= room) return gpu::kCellMaxAge;
    return std::max(gpu::kCellMinAge, static_cast<std::uint32_t>(gpu::kCellMaxAge * room / live_cells));
}

bool is_sweep_frame(const RenderPlan& plan, std::uint64_t frame, std::uint64_t live_cells) {
    const bool is_full = cell_age(plan, live_cells) < gpu::kCellMaxAge;
    return is_full || (frame % kSweepFrames == 0 && live_cells > plan.ao.slots / 8);
}

Plane record_ao_cells(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits, const AoStep& step,
                      Recording& recording) {
    VX_ASSERT_EQ(tile.row_count, static_cast<std::uint32_t>(plan.settings.size.y));
    recording.upload(declare<gpu::AoParams>(recording, "ao.frame", 1), to_bytes(step.params));
    if (step.params.has_last == 0) empty_table(plan, recording);
    if (step.sweeps) record_ao_age(plan, recording);
    const SlotPlanes planes = slot_planes(plan, step.params, recording);
    record_slots(plan, tile, hits, planes, recording);
    record_ao_sample(plan, tile, hits, planes, recording);
    const Resolved resolved = record_ao_resolve(plan, tile, planes, recording);
    if (plan.settings.ao.filter == 0) return {resolved.visibility};
    return record_ao_filter(plan, tile, hits, resolved, recording);
}

Plane record_ao(const RenderPlan& plan, const DispatchTile& tile, const Plane& hits, const AoStep& step,
                Recording& recording) {
    if (plan.ao.uses_cells()) return record_ao_cells(plan, tile, hits, step, recording);
    return record_ao_trace(plan, tile, hits, recording);
}

}  // namespace voxilux
