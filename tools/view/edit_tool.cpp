#include "view/edit_tool.h"

#include "base/error.h"
#include "base/file.h"
#include "formats/vox_read.h"
#include "formats/vox_write.h"
#include "view/view_state.h"
#include "world/vox_edits.h"

namespace voxilux {
namespace {

// A cube of the brush about a cell. On the axis of the face it lies on the far side of it: in front of the
// face where it is placed, else behind.
Box brush_box(glm::ivec3 cell, glm::ivec3 normal, int brush, bool is_placed) {
    Box box;
    box.lo = cell - (brush - 1) / 2;
    for (int axis = 0; axis < 3; ++axis) {
        if (normal[axis] == 0) continue;
        const bool grows_up = (normal[axis] > 0) == is_placed;
        box.lo[axis] = grows_up ? cell[axis] : cell[axis] + 1 - brush;
    }
    box.hi = box.lo + brush;
    return box;
}

void apply(std::span<const BoxEdit> edits, ViewState& state, std::vector<BoxEdit>* back) {
    if (state.picture.renderer().voxels() == nullptr) {
        state.message = "there are no voxels to edit";
        return;
    }
    try {
        std::vector<BoxEdit> undo = state.picture.edit(edits);
        if (back != nullptr) *back = std::move(undo);
        ++state.edit.edits;
        state.message.clear();
    } catch (const Error& error) {
        state.message = error.what();
    }
}

void use_tool(ViewState& state) {
    const std::optional<Box> box = tool_box(state.edit);
    if (!box) return;
    BoxEdit edit{*box, state.edit.material, state.edit.tool == Tool::paint};
    if (state.edit.tool == Tool::remove) edit.material.reset();
    make_edits({&edit, 1}, state);
}

}  // namespace

std::optional<Box> tool_box(const EditState& edit) {
    if (!edit.target || edit.tool == Tool::view) return std::nullopt;
    const PickedVoxel& target = *edit.target;
    const glm::ivec3 outside = target.cell + target.normal;
    switch (edit.tool) {
        case Tool::place:
            return brush_box(outside, target.normal, edit.brush, true);
        case Tool::fill: {
            const glm::ivec3 begin = edit.fill_begin.value_or(outside);
            return Box{glm::min(begin, outside), glm::max(begin, outside) + 1};
        }
        case Tool::pick:
            return Box{target.cell, target.cell + 1};
        default:
            return brush_box(target.cell, target.normal, edit.brush, false);
    }
}

void begin_stroke(ViewState& state) {
    EditState& edit = state.edit;
    if (!edit.target || edit.tool == Tool::view) return;
    if (edit.tool == Tool::pick) {
        edit.material = edit.target->material;
        edit.tool = Tool::paint;
    } else if (edit.tool == Tool::fill) {
        edit.fill_begin = edit.target->cell + edit.target->normal;
    } else {
        use_tool(state);
    }
}

void move_stroke(ViewState& state) {
    if (state.edit.tool == Tool::paint) use_tool(state);
}

void end_stroke(ViewState& state) {
    if (state.edit.tool != Tool::fill || !state.edit.fill_begin) return;
    use_tool(state);
    state.edit.fill_begin.reset();
}

void make_edits(std::span<const BoxEdit> edits, ViewState& state) {
    std::vector<BoxEdit> back;
    apply(edits, state, &back);
    if (!back.empty()) state.edit.history.add({edits.begin(), edits.end()}, std::move(back));
}

void undo_edit(ViewState& state) {
    if (const std::vector<BoxEdit>* const back = state.edit.history.undo()) apply(*back, state, nullptr);
}

void redo_edit(ViewState& state) {
    if (const std::vector<BoxEdit>* const made = state.edit.history.redo()) apply(*made, state, nullptr);
}

void aim(glm::ivec2 window, ViewState& state) {
    state.edit.target.reset();
    if (!state.picture.is_loaded()) return;
    const VoxelWorld* const world = state.picture.renderer().voxels();
    if (world == nullptr) return;
    const Camera& camera = state.view.camera;
    state.edit.target = pick_voxel(*world, camera.position,
                                   direction_through(camera, state.held.pointer + 0.5, glm::dvec2(window)));
}

void save_edits(const std::filesystem::path& file, ViewState& state) {
    try {
        const VoxelWorld* const world =
            state.picture.is_loaded() ? state.picture.renderer().voxels() : nullptr;
        if (!has_ending(state.input, ".vox") || world == nullptr)
            throw Error(ExitCode::input_refused, "only the edits of a .vox file can be saved");
        const VoxFile saved =
            with_voxels(load_vox(state.input), *world, state.picture.renderer().scene().materials);
        write_file_atomically(file, write_vox(saved));
        state.has_saved = true;
        state.message = "saved " + file.string();
    } catch (const Error& error) {
        state.message = error.what();
    }
}

}  // namespace voxilux
