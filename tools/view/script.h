#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scene/scene_bounds.h"
#include "view/input_event.h"

namespace voxilux {

struct ResizeAction {
    glm::ivec2 size{0};  // 0: minimise
};
// A picture of the window (.png), or the film (.exr).
struct ScreenshotAction {
    std::string file;
};
// The boxes' cells get a material, or air.
struct EditAction {
    Box box;
    std::optional<std::uint32_t> material;
};

// Writes the edited .vox file.
struct SaveAction {
    std::string file;
};

using ScriptAction = std::variant<InputEvent, ResizeAction, ScreenshotAction, EditAction, SaveAction>;

// What happens when the window has shown so many frames, or the picture at rest has so many samples.
struct ScriptStep {
    std::int64_t frame = -1;
    std::optional<std::uint32_t> samples;  // in the first frame with as many, from `frame` on
    ScriptAction action;
};

// A person's input on paper: what happens in which frame. Steps wait for those before.
struct ViewScript {
    std::vector<ScriptStep> steps;
};

// Reads [[step]] tables: `frame` or `samples`, and one of `key` (pressed and released), `press` and `release`
// (a key or a button), `move`, `scroll`, `drop`, `resize`, `screenshot`, `edit`, `save`, `close`. Throws
// Error(input_refused) with the line.
[[nodiscard]] ViewScript read_script(const std::filesystem::path& file);

// The number that GLFW gives a key of this name: "a", "7", "F12", "Enter"; nothing for others.
[[nodiscard]] std::optional<int> key_named(std::string_view name);

}  // namespace voxilux
