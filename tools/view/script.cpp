#include "view/script.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <array>
#include <cctype>
#include <utility>

#include "base/error.h"
#include "formats/toml_section.h"

namespace voxilux {
namespace {

constexpr std::array<std::string_view, 3> kButtons{"left", "right", "middle"};

// The order of the members matters: a step has exactly one of them.
constexpr std::array<std::string_view, 11> kActions{
    "key", "press", "release", "move", "scroll", "drop", "resize", "screenshot", "edit", "save", "close"};

constexpr Range kAny{.low = -1e6, .high = 1e6};

InputEvent press_or_release(const TomlSection& section, std::string_view key, bool is_down) {
    const std::string name = *section.get<std::string>(key);
    for (std::size_t i = 0; i < kButtons.size(); ++i)
        if (name == kButtons[i]) return ButtonEvent{static_cast<MouseButton>(i), is_down};
    const std::optional<int> number = key_named(name);
    if (!number) section.refuse(key, fmt::format("is '{}', neither a key nor a button", name));
    return KeyEvent{*number, is_down};
}

EditAction edit_of(const TomlSection& step, const toml::node& node) {
    if (!node.is_table()) step.refuse("edit", "is no table { from, to, material }");
    const TomlSection section(*node.as_table(), "edit", {"from", "to", "material"});
    EditAction edit;
    edit.box.lo = section.require(section.get<glm::ivec3>("from", kAny), "from");
    edit.box.hi = section.require(section.get<glm::ivec3>("to", kAny), "to") + 1;
    if (section.has("material"))
        edit.material = section.get<std::uint32_t>("material", {.low = 0, .high = 32767});
    return edit;
}

ScriptAction action_of(const TomlSection& section, std::string_view key) {
    if (key == "press") return press_or_release(section, key, true);
    if (key == "release") return press_or_release(section, key, false);
    if (key == "move") return InputEvent{MoveEvent{glm::dvec2(*section.get<glm::ivec2>(key, kAny))}};
    if (key == "scroll") return InputEvent{ScrollEvent{*section.get<double>(key, kAny)}};
    if (key == "drop") return InputEvent{DropEvent{*section.texts(key)}};
    if (key == "resize") return ResizeAction{*section.get<glm::ivec2>(key, {.low = 0, .high = 16384})};
    if (key == "screenshot") return ScreenshotAction{*section.get<std::string>(key)};
    if (key == "save") return SaveAction{*section.get<std::string>(key)};
    if (key == "edit") return edit_of(section, *section.find(key));
    return InputEvent{CloseEvent{}};
}

void add_step(const toml::table& table, ViewScript& script) {
    std::vector<std::string_view> keys(kActions.begin(), kActions.end());
    keys.insert(keys.end(), {"frame", "samples"});
    const TomlSection section(table, "[[step]]", keys);
    ScriptStep step;
    if (!script.steps.empty()) step.frame = script.steps.back().frame;
    if (section.has("frame")) step.frame = *section.get<int>("frame", {.low = 0, .high = 1e9});
    if (section.has("samples"))
        step.samples = *section.get<std::uint32_t>("samples", {.low = 1, .high = 1e6});
    std::optional<std::string_view> chosen;
    for (const std::string_view key : kActions) {
        if (!section.has(key)) continue;
        if (chosen) section.refuse(fmt::format("has both '{}' and '{}'", *chosen, key));
        chosen = key;
    }
    if (!chosen) section.refuse(fmt::format("needs one of {}", fmt::join(kActions, ", ")));
    if (*chosen == "key") {
        step.action = press_or_release(section, "key", true);
        script.steps.push_back(step);
        step.action = press_or_release(section, "key", false);
    } else {
        step.action = action_of(section, *chosen);
    }
    script.steps.push_back(std::move(step));
}

}  // namespace

std::optional<int> key_named(std::string_view name) {
    constexpr std::pair<std::string_view, int> kNames[] = {{"Enter", GLFW_KEY_ENTER},
                                                           {"Escape", GLFW_KEY_ESCAPE},
                                                           {"Tab", GLFW_KEY_TAB},
                                                           {"Space", GLFW_KEY_SPACE},
                                                           {"Delete", GLFW_KEY_DELETE},
                                                           {"Left", GLFW_KEY_LEFT},
                                                           {"Right", GLFW_KEY_RIGHT},
                                                           {"Up", GLFW_KEY_UP},
                                                           {"Down", GLFW_KEY_DOWN},
                                                           {"Shift", GLFW_KEY_LEFT_SHIFT},
                                                           {"Control", GLFW_KEY_LEFT_CONTROL},
                                                           {"F12", GLFW_KEY_F12},
                                                           {"Plus", GLFW_KEY_EQUAL},
                                                           {"Minus", GLFW_KEY_MINUS},
                                                           {"Period", GLFW_KEY_PERIOD},
                                                           {"Comma", GLFW_KEY_COMMA},
                                                           {"BracketLeft", GLFW_KEY_LEFT_BRACKET},
                                                           {"BracketRight", GLFW_KEY_RIGHT_BRACKET}};
    for (const auto& [known, number] : kNames)
        if (known == name) return number;
    if (name.size() != 1 || std::isalnum(static_cast<unsigned char>(name[0])) == 0) return std::nullopt;
    return std::toupper(static_cast<unsigned char>(name[0]));
}

ViewScript read_script(const std::filesystem::path& file) {
    toml::table root;
    try {
        root = toml::parse_file(file.string());
    } catch (const toml::parse_error& error) {
        refuse_at(error.source(), std::string(error.description()));
    }
    const TomlSection section(root, "the script", {"step"});
    const toml::node* const steps = section.find("step");
    if (steps == nullptr || !steps->is_array_of_tables()) section.refuse("needs [[step]] tables");
    ViewScript script;
    for (const toml::node& step : *steps->as_array())
        add_step(*step.as_table(), script);
    return script;
}

}  // namespace voxilux
