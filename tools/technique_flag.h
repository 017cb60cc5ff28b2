#pragma once

// --technique, common to the subcommands that read a scene.

#include <span>
#include <string>
#include <string_view>

#include "scene/scene.h"

namespace voxilux {

struct NamedTechnique {
    std::string_view effect;
    std::string_view name;
};

// "EFFECT=NAME". Throws Error(usage), with a hint, for names that are not known.
[[nodiscard]] NamedTechnique parse_technique(std::string_view text);

// The sentence of --help: effects and the names of their techniques.
[[nodiscard]] std::string technique_help();

// Sets the techniques in the settings. Throws Error(usage) for two that exclude each other.
void choose_techniques(std::span<const NamedTechnique> named, RenderSettings& settings);

}  // namespace voxilux
