#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "quality.h"
#include "scene/animation.h"
#include "view/edit_tool.h"
#include "view/input_event.h"
#include "view/live_picture.h"
#include "view/pixel_reading.h"
#include "view/view_point.h"
#include "view/window_memory.h"

namespace voxilux {

enum class PanelSide : std::uint8_t { left, right };

// What the panels show and change, and what input does.
struct ViewState {
    explicit ViewState(LivePicture& live) : picture(live) {}

    LivePicture& picture;
    std::filesystem::path input;  // empty: nothing is loaded
    Box box;                      // of the scene
    ViewPoint view;
    ViewPoint home;
    InputState held;
    float exposure_ev = 0.0f;
    DisplayLook look;
    double divider = 0.5;  // between picture and reference, of the window's width
    bool drags_divider = false;
    std::string reference_name;           // empty: there is none
    std::optional<PixelReading> reading;  // of the pixel under the pointer, at rest
    EditState edit;
    std::optional<FrameRange> frames;  // of an animation
    std::int64_t frame = 0;
    bool is_playing = false;
    bool turns_sun = false;
    bool has_moved_sun = false;
    bool had_shadow_only = false;  // of the ground, which a window always shows
    bool has_saved = false;        // the edits to the scene's file
    bool has_newer_file = false;   // somebody wrote it, and loading it would lose edits
    bool wants_command = false;    // the render command of this view
    SampleEnds ends;
    const QualityPreset* quality = nullptr;  // that was chosen
    WindowMemory memory;
    std::string file_to_open;  // chosen in a panel
    bool shows_panels = true;
    bool shows_keys = false;
    std::array<float, 2> panel_ends{};  // pixels from the top, by side
    double frame_s = 0.0;               // duration of the last frame
    std::string message;                // shown in a panel; empty: none
    bool wants_close = false;
    std::vector<std::string> screenshots;  // to be taken of this frame
};

}  // namespace voxilux
