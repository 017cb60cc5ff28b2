#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "formats/toml_scene.h"
#include "formats/toml_section.h"

namespace voxilux {

// The name that carves instead of filling.
inline constexpr std::string_view kAir = "air";

// The index of a [material.NAME] in the scene; refused at `key` with the nearest name when there is none.
[[nodiscard]] std::uint32_t find_material(const TomlScene& in, const TomlSection& section,
                                          std::string_view key, const std::string& name);

}  // namespace voxilux
