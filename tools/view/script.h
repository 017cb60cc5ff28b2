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
// Fills a box of cells with a material, or with air.
struct EditAction {
    Box box;
    std::optional<std::uint32_t> material;
};

// Writes the edited .vox file.
struct SaveAction {
    std::string file;
};

using ScriptAction = std::variant<InputEvent, ResizeAction, ScreenshotAction, EditAction, SaveAction>;

// An action, and when it is due: after so many frames were shown, or when the picture at rest has so many
// samples.
struct ScriptStep {
    std::int64_t frame = -1;
    std::optional<std::uint32_t> samples;  // due in the first frame with as many, from `frame` on
    ScriptAction action;
};

// The input of a person, written down. Each step waits for those before it.
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
