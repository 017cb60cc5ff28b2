#pragma once

// What the subcommands share: flags common to several, and how results reach the user.

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "session/render_session.h"

namespace voxilux {

// Flags common to render and plan, as typed; empty where the user said nothing.
struct SceneOptions {
    std::string input;
    std::optional<std::string> size;
    std::optional<std::uint32_t> spp;
    std::optional<std::uint32_t> ao_rays;
    std::optional<float> ao_radius;
    std::optional<std::uint32_t> seed;
    std::optional<std::string> sequence;
    std::vector<std::string> effects;    // NAME=on|off|auto
    std::vector<std::string> overrides;  // -D key=value
    int frame = 0;
    std::string device;
    std::uint64_t memory_budget_mib = 0;
    std::string json;
};

void add_scene_flags(CLI::App& command, SceneOptions& options);

// The scene with the flags applied. Throws Error(usage) for a flag that cannot be read, Error(input_refused) for a file.
[[nodiscard]] Scene load_scene_with(const SceneOptions& options);

[[nodiscard]] PlanRequest plan_request(const SceneOptions& options);

// "640x360" as two numbers; Error(usage) otherwise.
[[nodiscard]] glm::ivec2 parse_size(const std::string& text);

// Writes JSON to a file, or to standard output for "-". Nothing for an empty name.
void write_json(const std::string& file, const nlohmann::ordered_json& json);

}  // namespace voxilux
