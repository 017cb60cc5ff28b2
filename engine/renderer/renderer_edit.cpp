// Edits of voxels that reach the device word by word.

#include <cstring>

#include "frame/footprint.h"
#include "passes/upload.h"
#include "renderer/renderer.h"

namespace voxilux {
namespace {

// Above so many cells, the device builds the structure faster than the host edits it.
constexpr std::size_t kMaxCells = std::size_t{1} << 20;

bool fits(const std::vector<std::uint32_t>& words, std::uint64_t bytes) {
    return words.size() * sizeof(std::uint32_t) <= bytes;
}

void copy_words(const RunResult& result, const std::string& buffer, std::vector<std::uint32_t>& words) {
    if (!words.empty())
        std::memcpy(words.data(), result.readbacks.at(buffer).data(), words.size() * sizeof(std::uint32_t));
}

}  // namespace

std::vector<BoxEdit> Renderer::edit(std::span<const BoxEdit> edits) {
    VX_ASSERT(editing_.has_value());
    StepTimes times;
    VoxelChange change = editing_->voxels.apply(edits);
    times.end_step("edit.voxels");
    const bool was_stale = std::exchange(editing_->is_stale, true);
    is_framed_ = false;
    const bool may_edit = !was_stale && !change.has_moved && change.cells.size() <= kMaxCells &&
                          plan().has(Effect::voxels) && has_free_boxes(plan().world.traversal);
    const bool is_edited = may_edit && edit_structure(change.cells, times);
    if (!is_edited) adopt(prepare_again(scene_, request_), scene_, request_);
    add_step_times(built_, times.steps());
    editing_->is_stale = false;
    return std::move(change.back);
}

// Reads the boxes that grew on the device.
void Renderer::fetch_boxes() {
    if (std::exchange(editing_->is_grown, true)) return;
    MarchWorld& world = prepared_->march_world;
    Recording recording;
    const WorldBuffers buffers = world_buffers(plan(), recording);
    recording.readback(buffers.roots, 0, world.roots.size() * sizeof(std::uint32_t));
    if (!world.nodes.empty())
        recording.readback(buffers.nodes, 0, world.nodes.size() * sizeof(std::uint32_t));
    const RunResult result = executor().run(recording);
    copy_words(result, buffers.roots, world.roots);
    copy_words(result, buffers.nodes, world.nodes);
}

// False where the device has no room for what was added.
bool Renderer::edit_structure(std::span<const VoxelEdit> cells, StepTimes& times) {
    fetch_boxes();
    EditableVoxels& voxels = editing_->voxels;
    MarchWorld& built = prepared_->march_world;
    editing_->regrowth.reset();
    const WorldChanges changes = edit_world(voxels.world(), built, cells);
    editing_->has_stale_boxes |= changes.has_stale_boxes;
    times.end_step("edit.structure");
    WorldFacts world = plan().world;
    if (!fits(built.nodes, world.node_bytes) || !fits(built.leaves, world.leaf_bytes)) return false;
    const SceneFacts facts = measure_scene(scene_, voxels.facts());
    LightList lights = find_lights(scene_, &voxels.world(), built.origin);
    world.lights = measure_lights(scene_, lights, built.size(), built.origin);
    aim_photons(scene_, facts, built.origin, request_, lights, world.lights);
    times.end_step("edit.lights");
    prepared_->plan = plan_within_memory(scene_, facts, world, request_, limits_);
    prepared_->facts = facts;
    prepared_->lights = std::move(lights);
    upload();
    record_world_edit(built, changes, world_buffers(plan(), pending_), pending_);
    record_materials_upload(plan(), scene_, built.origin, prepared_->lights, pending_);
    FrameState state = steps_->state();
    state.change_world();
    start_plan(state);
    times.end_step("edit.plan");
    return true;
}

bool Renderer::regrow_boxes() {
    if (!editing_ || !editing_->has_stale_boxes) return false;
    MarchWorld& built = prepared_->march_world;
    if (!editing_->regrowth) {
        editing_->regrowth = std::make_unique<Regrowth>(built);
        return true;
    }
    if (editing_->regrowth->step()) return true;
    const WorldChanges changes = editing_->regrowth->finish(built);
    editing_->regrowth.reset();
    editing_->has_stale_boxes = false;
    upload();
    record_world_edit(built, changes, world_buffers(plan(), pending_), pending_);
    return false;
}

}  // namespace voxilux
