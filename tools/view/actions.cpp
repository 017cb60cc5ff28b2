#include "view/actions.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "view/mesh_drop.h"
#include "view/picture_look.h"
#include "view/quality_choice.h"

namespace voxilux {
namespace {

constexpr double kFlightPerSecond = 0.5;  // of the distance to the centre
constexpr float kExposureStep = 0.5f;     // stops
constexpr float kSunTurn = 5.0f;          // degrees
constexpr float kSunRise = 2.5f;          // likewise

void look_from(View side, glm::ivec2 window, ViewState& state) {
    Camera looking = looking_along(side, state.view.camera.fov_y_deg);
    looking.projection = state.view.camera.projection;
    state.view = view_of(framing_camera(state.box, looking, glm::dvec2(glm::max(window, 1))), state.box);
}

// Turning may bring any part of the scene in front of a camera of parallel rays, so it steps back first.
void orbit(glm::dvec2 way, glm::ivec2 window, ViewState& state) {
    state.view = orbited(stepped_back(state.view, state.box), way, glm::dvec2(window));
}

void take_screenshot(const char* ending, ViewState& state) {
    const std::string stem = state.input.empty() ? "voxilux" : state.input.stem().string();
    state.screenshots.push_back(unused_name(stem, ending, 1));
}

void open_other(ViewState& state) {
    const std::vector<std::string> files = files_to_open(state.memory);
    if (files.empty())
        state.message = "no other file was shown";
    else
        state.file_to_open = files.front();
}

// The frames make a ring: the first one follows the last.
void show_frame(std::int64_t frame, ViewState& state) {
    if (!state.frames) return;
    const auto& [first, last] = *state.frames;
    state.frame = frame > last ? first : frame < first ? last : frame;
}

// Turns or raises the sun.
void move_sun(float azimuth_deg, float elevation_deg, ViewState& state) {
    if (!state.picture.is_loaded()) return;
    Sun sun = state.picture.renderer().scene().sun;
    if (!sun.on) {
        state.message = "the scene has no sun";
        return;
    }
    sun.azimuth_deg = std::remainder(sun.azimuth_deg + azimuth_deg, 360.0f);
    sun.elevation_deg = std::clamp(sun.elevation_deg + elevation_deg, -90.0f, 90.0f);
    try {
        state.picture.set_sun(sun);
        state.has_moved_sun = true;
        state.message = fmt::format("sun: azimuth {}, elevation {}", sun.azimuth_deg, sun.elevation_deg);
    } catch (const Error& error) {
        state.message = error.what();
    }
}

// What a key that is held down does again and again; false for other keys.
bool take_repeating_key(int key, ViewState& state) {
    switch (key) {
        case GLFW_KEY_LEFT:
            move_sun(kSunTurn, 0.0f, state);
            return true;
        case GLFW_KEY_RIGHT:
            move_sun(-kSunTurn, 0.0f, state);
            return true;
        case GLFW_KEY_UP:
            move_sun(0.0f, kSunRise, state);
            return true;
        case GLFW_KEY_DOWN:
            move_sun(0.0f, -kSunRise, state);
            return true;
        default:
            return false;
    }
}

void choose_tool(int key, ViewState& state) {
    constexpr std::pair<int, Tool> kTools[] = {{GLFW_KEY_V, Tool::view},   {GLFW_KEY_P, Tool::place},
                                               {GLFW_KEY_R, Tool::remove}, {GLFW_KEY_B, Tool::paint},
                                               {GLFW_KEY_F, Tool::fill},   {GLFW_KEY_I, Tool::pick}};
    for (const auto& [tool_key, tool] : kTools)
        if (tool_key == key) state.edit.tool = tool;
}

void take_key(int key, glm::ivec2 window, ViewState& state) {
    switch (key) {
        case GLFW_KEY_1:
            return look_from(View::front, window, state);
        case GLFW_KEY_3:
            return look_from(View::right, window, state);
        case GLFW_KEY_5:
            state.view = with_other_projection(state.view, state.box, glm::dvec2(window));
            return;
        case GLFW_KEY_7:
            return look_from(View::top, window, state);
        case GLFW_KEY_9:
            return look_from(View::iso, window, state);
        case GLFW_KEY_ENTER:
            state.view = state.home;
            return;
        case GLFW_KEY_H:
            state.shows_keys = !state.shows_keys;
            return;
        case GLFW_KEY_TAB:
            state.shows_panels = !state.shows_panels;
            return;
        case GLFW_KEY_T:
            state.look.curve = state.look.curve == ToneMap::filmic ? ToneMap::plain : ToneMap::filmic;
            return;
        case GLFW_KEY_EQUAL:
            return expose(state.exposure_ev + kExposureStep, state);
        case GLFW_KEY_MINUS:
            return expose(state.exposure_ev - kExposureStep, state);
        case GLFW_KEY_F12:
            return take_screenshot(state.held.shift ? ".exr" : ".png", state);
        case GLFW_KEY_C:
            return step_channel(state.held.shift ? -1 : 1, state);
        case GLFW_KEY_X:
            return step_comparison(state);
        case GLFW_KEY_G:
            return step_quality(state);
        case GLFW_KEY_O:
            return open_other(state);
        case GLFW_KEY_SPACE:
            state.is_playing = !state.is_playing && state.frames;
            return;
        case GLFW_KEY_PERIOD:
            return show_frame(state.frame + 1, state);
        case GLFW_KEY_COMMA:
            return show_frame(state.frame - 1, state);
        case GLFW_KEY_LEFT_BRACKET:
            state.edit.brush = std::max(state.edit.brush - 1, 1);
            return;
        case GLFW_KEY_RIGHT_BRACKET:
            state.edit.brush = std::min(state.edit.brush + 1, kMaxBrush);
            return;
        case GLFW_KEY_ESCAPE:
            state.wants_close = true;
            return;
        default:
            return choose_tool(key, state);
    }
}

void take_shortcut(int key, ViewState& state) {
    if (key == GLFW_KEY_Z) return state.held.shift ? redo_edit(state) : undo_edit(state);
    if (key == GLFW_KEY_Y) return redo_edit(state);
    if (key == GLFW_KEY_S) return save_edits(state.input, state);
    if (key == GLFW_KEY_C) state.wants_command = true;
}

void take_move(glm::dvec2 place, glm::ivec2 window, ViewState& state) {
    const glm::dvec2 way = place - std::exchange(state.held.pointer, place);
    aim(window, state);
    if (state.drags_divider)
        state.divider = std::clamp(place.x / window.x, 0.0, 1.0);
    else if (state.held.holds(MouseButton::right))
        state.view = looked(state.view, way, glm::dvec2(window));
    else if (state.held.holds(MouseButton::middle) ||
             (state.held.shift && state.held.holds(MouseButton::left)))
        state.view = panned(state.view, way, glm::dvec2(window));
    else if (state.held.holds(MouseButton::left) && state.edit.tool != Tool::view)
        move_stroke(state);
    else if (state.held.holds(MouseButton::left))
        orbit(way, window, state);
}

// Pixels from the divider within which it is dragged.
constexpr double kDividerReach = 6.0;

void take_button(const ButtonEvent& button, glm::ivec2 window, ViewState& state) {
    state.held.buttons[static_cast<int>(button.button)] = button.is_down;
    if (button.button != MouseButton::left) return;
    if (!button.is_down) {
        state.drags_divider = false;
        return end_stroke(state);
    }
    state.drags_divider =
        is_wiping(state) && std::abs(state.held.pointer.x - state.divider * window.x) < kDividerReach;
    if (state.drags_divider || state.held.shift) return;
    aim(window, state);
    begin_stroke(state);
}

void hold(const KeyEvent& key, InputState& held) {
    if (key.key < 0 || key.key >= static_cast<int>(std::size(held.keys))) return;
    held.keys[key.key] = key.is_down;
    held.shift = held.keys[GLFW_KEY_LEFT_SHIFT] || held.keys[GLFW_KEY_RIGHT_SHIFT];
    held.control = held.keys[GLFW_KEY_LEFT_CONTROL] || held.keys[GLFW_KEY_RIGHT_CONTROL];
}

}  // namespace

void take_event(const InputEvent& event, glm::ivec2 window, ViewState& state) {
    if (const auto* key = std::get_if<KeyEvent>(&event)) {
        hold(*key, state.held);
        if (!key->is_down || take_repeating_key(key->key, state) || key->is_repeat) return;
        if (state.held.control)
            take_shortcut(key->key, state);
        else
            take_key(key->key, window, state);
    } else if (const auto* button = std::get_if<ButtonEvent>(&event)) {
        take_button(*button, window, state);
    } else if (const auto* move = std::get_if<MoveEvent>(&event)) {
        take_move(move->place, window, state);
    } else if (const auto* scroll = std::get_if<ScrollEvent>(&event)) {
        state.view = zoomed(state.view, scroll->steps, state.held.pointer, glm::dvec2(window));
    } else if (std::holds_alternative<CloseEvent>(event)) {
        state.wants_close = true;
    }
}

void fly(double seconds, ViewState& state) {
    if (state.held.control) return;
    const auto axis = [&](int plus, int minus) {
        return static_cast<double>(state.held.keys[plus]) - static_cast<double>(state.held.keys[minus]);
    };
    const glm::dvec3 way{axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q),
                         axis(GLFW_KEY_W, GLFW_KEY_S)};
    if (way == glm::dvec3(0.0)) return;
    const double distance = glm::length(state.view.centre - state.view.camera.position);
    state.view = flown(state.view, way * (kFlightPerSecond * seconds * std::max(distance, 8.0)));
}

std::span<const std::pair<const char*, const char*>> key_sheet() {
    static constexpr std::array<std::pair<const char*, const char*>, 26> kSheet{{
        {"left drag", "orbit"},
        {"middle or shift drag", "pan"},
        {"right drag", "look around"},
        {"wheel", "zoom to the pointer"},
        {"W A S D Q E", "fly"},
        {"1 3 7 9", "front, right, top, iso"},
        {"5", "parallel rays or perspective"},
        {"Enter", "the first view again"},
        {"arrows", "turn the sun, raise or lower it"},
        {"+ -", "exposure"},
        {"C, shift C", "the next channel, the one before"},
        {"X", "compare with the reference"},
        {"G", "the next quality preset"},
        {"O", "the file that was shown before"},
        {"V P R B F I", "view, place, remove, paint, fill, pick"},
        {"[ ]", "a smaller, a larger brush"},
        {"Ctrl Z, Ctrl Y", "undo, redo"},
        {"Ctrl S", "save the .vox"},
        {"Ctrl C", "copy the command that renders this view"},
        {"Space", "play or pause an animation"},
        {", .", "the frame before, the next one"},
        {"T", "tone curve"},
        {"F12", "screenshot; with shift the film as EXR"},
        {"Tab", "panels"},
        {"H", "this sheet"},
        {"Esc", "close"},
    }};
    return kSheet;
}

}  // namespace voxilux
