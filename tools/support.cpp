#include "support.h"

#include <charconv>
#include <iostream>

#include "base/error.h"
#include "base/file.h"
#include "scene/scene_toml.h"

namespace voxilux {

void add_scene_flags(CLI::App& command, SceneOptions& options) {
    command.add_option("input", options.input, "a .vox file or a scene .toml")->required();
    command.add_option("--size", options.size, "picture size in pixels, WxH");
    command.add_option("--spp", options.spp, "samples per pixel");
    command.add_option("--ao-rays", options.ao_rays, "occlusion rays per sample");
    command.add_option("--ao-radius", options.ao_radius, "reach of occlusion rays, voxels");
    command.add_option("--seed", options.seed, "seed of every random stream");
    command.add_option("--sequence", options.sequence, "sample sequence: sobol, halton or white");
    command.add_option("--effect", options.effects, "NAME=on|off|auto: override the plan; may repeat");
    command.add_option("-D", options.overrides, "key=value: override a key of the scene file; may repeat");
    command.add_option("--frame", options.frame, "frame of an animated .vox file")->capture_default_str();
    command.add_option("--device", options.device, "Vulkan device by index or part of its name");
    command.add_option("--memory-budget", options.memory_budget_mib, "most device memory, MiB (0: no limit)");
    command.add_option("--json", options.json, "write the report as JSON to a file, - for standard output");
}

glm::ivec2 parse_size(const std::string& text) {
    glm::ivec2 size(0);
    const char* const end = text.data() + text.size();
    const auto [cross, width_error] = std::from_chars(text.data(), end, size.x);
    if (width_error == std::errc() && cross != end && *cross == 'x') {
        const auto [rest, height_error] = std::from_chars(cross + 1, end, size.y);
        if (height_error == std::errc() && rest == end && size.x > 0 && size.y > 0) return size;
    }
    throw Error(ExitCode::usage, fmt::format("--size: '{}' is not WIDTHxHEIGHT, such as 1280x720", text));
}

namespace {

Sequence parse_sequence(const std::string& name) {
    if (name == "sobol") return Sequence::sobol;
    if (name == "halton") return Sequence::halton;
    if (name == "white") return Sequence::white;
    throw Error(ExitCode::usage, fmt::format("--sequence: '{}' is not sobol, halton or white", name));
}

Switch parse_switch(const std::string& text, const std::string& whole) {
    if (text == "on") return Switch::on;
    if (text == "off") return Switch::off;
    if (text == "auto") return Switch::automatic;
    throw Error(ExitCode::usage, fmt::format("--effect: '{}' must be NAME=on, NAME=off or NAME=auto", whole));
}

}  // namespace

Scene load_scene_with(const SceneOptions& options) {
    Scene scene = load_scene(options.input, {.overrides = options.overrides, .frame = options.frame});
    if (options.size) scene.settings.size = parse_size(*options.size);
    if (options.spp) scene.settings.spp = *options.spp;
    if (options.ao_rays) scene.settings.ao_rays = *options.ao_rays;
    if (options.ao_radius) scene.settings.ao_radius = *options.ao_radius;
    if (options.seed) scene.settings.seed = *options.seed;
    if (options.sequence) scene.settings.sequence = parse_sequence(*options.sequence);
    return scene;
}

PlanRequest plan_request(const SceneOptions& options) {
    PlanRequest request;
    for (const std::string& text : options.effects) {
        const std::size_t equals = text.find('=');
        const std::string value = equals == std::string::npos ? "" : text.substr(equals + 1);
        const Switch choice = parse_switch(value, text);
        request.effects.switches[effect_named(text.substr(0, equals))] = choice;
    }
    request.memory_budget_bytes = options.memory_budget_mib << 20;
    return request;
}

void write_json(const std::string& file, const nlohmann::ordered_json& json) {
    if (file.empty()) return;
    const std::string text = json.dump(2) + "\n";
    if (file == "-")
        std::cout << text << std::flush;
    else
        write_file_atomically(file, std::as_bytes(std::span(text)));
}

}  // namespace voxilux
