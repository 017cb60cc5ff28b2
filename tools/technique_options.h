#pragma once

// --technique, common to the subcommands that read a scene.

#include <span>
#include <string>

#include "scene/scene.h"

namespace voxilux {

// Sentences for --help: effects and the names of their techniques.
[[nodiscard]] std::string technique_help();

// The settings with the techniques chosen that the texts name, "EFFECT=NAME" each. Throws Error(usage) for
// what is not known, with a hint, and for two that exclude each other.
[[nodiscard]] RenderSettings with_techniques(RenderSettings settings, std::span<const std::string> texts);

}  // namespace voxilux
