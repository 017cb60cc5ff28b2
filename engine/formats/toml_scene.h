#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include <toml++/toml.h>

#include "formats/toml_section.h"
#include "scene/scene.h"

namespace voxilux {

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
void read_technique(TomlScene& in);  // after the sections whose settings it may change
void read_materials(TomlScene& in);
void read_models(TomlScene& in);
void read_shapes(TomlScene& in);
void read_spheres(TomlScene& in);
void read_camera(TomlScene& in);  // last: a preset frames everything else

// The table of a section like [sun]; null when absent, refused when it is no table.
[[nodiscard]] const toml::table* find_section(const TomlScene& in, std::string_view name);

// The tables of a repeated section like [[shape]]; refused when it is anything else.
[[nodiscard]] std::vector<const toml::table*> find_sections(const TomlScene& in, std::string_view name);

// The name that carves instead of filling.
inline constexpr std::string_view kAir = "air";

// The index of a [material.NAME] in the scene; refused at `key` with the nearest name when there is none.
[[nodiscard]] std::uint32_t find_material(const TomlScene& in, const TomlSection& section,
                                          std::string_view key, const std::string& name);

}  // namespace voxilux
