#pragma once

// What a person or a script does to the window.

#include <string>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

namespace voxilux {

// `key` is one of GLFW's numbers: letters and digits are their ASCII capitals.
struct KeyEvent {
    int key = 0;
    bool is_down = true;
    bool is_repeat = false;
};
struct TextEvent {
    unsigned codepoint = 0;
};
enum class MouseButton : std::uint8_t { left, right, middle };
struct ButtonEvent {
    MouseButton button = MouseButton::left;
    bool is_down = true;
};
// Pixels of the window from its top left corner.
struct MoveEvent {
    glm::dvec2 place{0.0};
};
// Steps of the wheel.
struct ScrollEvent {
    double steps = 0.0;
};
struct DropEvent {
    std::vector<std::string> files;
};
struct CloseEvent {};

using InputEvent =
    std::variant<KeyEvent, TextEvent, ButtonEvent, MoveEvent, ScrollEvent, DropEvent, CloseEvent>;

// What is held down, and where the pointer is, after the events so far.
struct InputState {
    glm::dvec2 pointer{0.0};
    bool shift = false;
    bool control = false;
    bool buttons[3] = {};
    bool keys[512] = {};

    [[nodiscard]] bool holds(MouseButton button) const { return buttons[static_cast<int>(button)]; }
};

}  // namespace voxilux
