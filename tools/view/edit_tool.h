#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/edit_history.h"
#include "world/pick_voxel.h"

namespace voxilux {

struct ViewState;

// What the left button does.
enum class Tool : std::uint8_t { view, place, remove, paint, fill, pick };
inline constexpr std::array<std::string_view, 6> kToolNames{"view",  "place", "remove",
                                                            "paint", "fill",  "pick"};

inline constexpr int kMaxBrush = 32;

// What the brush changed since the button went down: one step to undo.
struct Stroke {
    std::vector<BoxEdit> made;
    std::vector<BoxEdit> back;
};

struct EditState {
    Tool tool = Tool::view;
    int brush = 1;  // voxels along the edge of a cube
    std::uint32_t material = 0;
    std::optional<PickedVoxel> target;     // under the pointer
    std::optional<glm::ivec3> fill_begin;  // the cell where a box begins
    std::optional<Stroke> stroke;          // while the brush paints
    EditHistory history;
    std::int64_t unsaved = 0;  // steps since the file was saved; below 0: steps undone since then
    std::uint64_t edits = 0;   // edits made, undone and redone so far
};

// The cells that the tool would change at its target.
[[nodiscard]] std::optional<Box> tool_box(const EditState& edit);

// Called when the left button goes down, when the pointer moves while it is down, and when it goes up. The
// tool `view` does nothing.
void begin_stroke(ViewState& state);
void move_stroke(ViewState& state);
void end_stroke(ViewState& state);

// Whether the voxels differ from those of the file.
[[nodiscard]] bool is_unsaved(const EditState& edit);
// Called when other voxels are shown: there is nothing to undo, redo or save any more.
void forget_edits(EditState& edit);

// Makes edits that can be taken back. What cannot be done becomes the state's message.
void make_edits(std::span<const BoxEdit> edits, ViewState& state);
void undo_edit(ViewState& state);
void redo_edit(ViewState& state);

// Finds the voxel under the pointer, in a window of `window` pixels.
void aim(glm::ivec2 window, ViewState& state);

// Writes the scene's .vox file with the edits.
void save_edits(const std::filesystem::path& file, ViewState& state);

}  // namespace voxilux
