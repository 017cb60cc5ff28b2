#pragma once

#include <optional>
#include <string_view>

#include <glm/glm.hpp>

#include "formats/toml_section.h"

namespace voxilux {

// Radiance and irradiance: far above any sun, and its square is still far inside a float.
inline constexpr Range kLightRange{0.0, 1e6};

// The linear value of "#rrggbb" (sRGB), nothing when the key is absent.
[[nodiscard]] std::optional<glm::vec3> read_colour(const TomlSection& section, std::string_view key);

}  // namespace voxilux
