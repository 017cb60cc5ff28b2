#include "view/edit_tool.h"

#include "base/error.h"
#include "base/file.h"
#include "formats/vox_read.h"
#include "formats/vox_write.h"
#include "view/view_state.h"
#include "world/vox_edits.h"

namespace voxilux {
namespace {

// A cube of the brush around a cell. Along the normal of the face it grows outwards where voxels are placed,
// and inwards otherwise.
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

// An edit after an undo past the saved state makes that state unreachable: no number of undos or redos leads
// back.
constexpr std::int64_t kUnreachable = std::int64_t{1} << 62;

void remember(std::vector<BoxEdit> made, std::vector<BoxEdit> back, EditState& edit) {
    if (back.empty()) return;
    edit.history.add(std::move(made), std::move(back));
    edit.unsaved = edit.unsaved < 0 ? kUnreachable : edit.unsaved + 1;
}

void end_brush(EditState& edit) {
    if (!edit.stroke) return;
    remember(std::move(edit.stroke->made), std::move(edit.stroke->back), edit);
    edit.stroke.reset();
}

void paint(ViewState& state) {
    if (!state.edit.stroke) state.edit.stroke.emplace();
    use_tool(state);
}

}  // namespace

bool is_unsaved(const EditState& edit) {
    return edit.unsaved != 0 || (edit.stroke && !edit.stroke->back.empty());
}

void forget_edits(EditState& edit) {
    edit.stroke.reset();
    edit.history = {};
    edit.unsaved = 0;
}

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
    if (edit.tool == Tool::paint) return paint(state);
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
    if (state.edit.tool == Tool::paint) paint(state);
}

void end_stroke(ViewState& state) {
    end_brush(state.edit);
    if (state.edit.tool != Tool::fill || !state.edit.fill_begin) return;
    use_tool(state);
    state.edit.fill_begin.reset();
}

void make_edits(std::span<const BoxEdit> edits, ViewState& state) {
    std::vector<BoxEdit> back;
    apply(edits, state, &back);
    if (!state.edit.stroke) return remember({edits.begin(), edits.end()}, std::move(back), state.edit);
    if (back.empty()) return;
    Stroke& stroke = *state.edit.stroke;
    stroke.made.insert(stroke.made.end(), edits.begin(), edits.end());
    stroke.back.insert(stroke.back.begin(), back.begin(), back.end());  // the last one is taken back first
}

void undo_edit(ViewState& state) {
    end_brush(state.edit);
    const std::vector<BoxEdit>* const back = state.edit.history.undo();
    if (back == nullptr) return;
    --state.edit.unsaved;
    apply(*back, state, nullptr);
}

void redo_edit(ViewState& state) {
    end_brush(state.edit);
    const std::vector<BoxEdit>* const made = state.edit.history.redo();
    if (made == nullptr) return;
    ++state.edit.unsaved;
    apply(*made, state, nullptr);
}

void aim(glm::ivec2 window, ViewState& state) {
    state.edit.target.reset();
    if (!state.picture.is_loaded()) return;
    const VoxelWorld* const world = state.picture.renderer().voxels();
    if (world == nullptr) return;
    const Camera& camera = state.view.camera;
    if (camera.projection != Projection::perspective && camera.projection != Projection::orthographic) return;
    const ViewRay ray = ray_through(camera, state.held.pointer + 0.5, glm::dvec2(window));
    state.edit.target = pick_voxel(*world, ray.start, ray.direction);
}

void save_edits(const std::filesystem::path& file, ViewState& state) {
    end_brush(state.edit);
    try {
        const VoxelWorld* const world =
            state.picture.is_loaded() ? state.picture.renderer().voxels() : nullptr;
        if (!has_ending(state.input, ".vox") || world == nullptr)
            throw Error(ExitCode::input_refused, "only the edits of a .vox file can be saved");
        const VoxFile saved =
            with_voxels(load_vox(state.input), *world, state.picture.renderer().scene().materials);
        write_file_atomically(file, write_vox(saved));
        std::error_code ignored;
        if (std::filesystem::equivalent(file, state.input, ignored)) {
            state.has_saved = true;
            state.has_newer_file = false;
            state.edit.unsaved = 0;
        }
        state.message = "saved " + file.string();
    } catch (const Error& error) {
        state.message = error.what();
    }
}

}  // namespace voxilux
