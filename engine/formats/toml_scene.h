#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include <toml++/toml.h>

#include "scene/scene.h"

namespace voxilux {

// Degrees of an angle: ten turns, for the sake of animations.
inline constexpr double kMaxTurn = 3600.0;

// What the sections of a scene file share while they are read.
struct TomlScene {
    const toml::table& root;
    std::filesystem::path folder;  // models are relative to it
    int frame = 0;
    Scene& scene;                                    // filled by the readers
    std::map<std::string, std::uint32_t> materials;  // by name, into scene.materials
};

// Each reads one kind of section into the scene, in this order, and refuses what is wrong with
// Error(input_refused).
void read_render(TomlScene& in);
void read_ao(TomlScene& in);
void read_photons(TomlScene& in);
void read_technique(TomlScene& in);  // after those whose settings it may change
void read_sun(TomlScene& in);
void read_sky(TomlScene& in);
void read_materials(TomlScene& in);
void read_models(TomlScene& in);
void read_shapes(TomlScene& in);
void read_spheres(TomlScene& in);
void read_camera(TomlScene& in);  // last: a preset frames everything else

// The table of a section like [sun]; null when absent, refused when it is no table.
[[nodiscard]] const toml::table* find_section(const TomlScene& in, std::string_view name);

// The tables of a repeated section like [[shape]]; refused when it is anything else.
[[nodiscard]] std::vector<const toml::table*> find_sections(const TomlScene& in, std::string_view name);

}  // namespace voxilux
