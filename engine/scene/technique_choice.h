#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace voxilux {

// A technique by the name that [technique] of a scene file and --technique give it, and the settings that
// choose it. plan/techniques.h says what the techniques are.
struct TechniqueChoice {
    std::string_view effect;
    std::string_view name;
    void (*choose)(RenderSettings&);
};

// All of them, those of an effect together. `auto` leaves the choice to the plan.
[[nodiscard]] std::span<const TechniqueChoice> technique_choices();

// The effects with techniques to choose from, and the names of those of one.
[[nodiscard]] std::vector<std::string_view> effects_with_techniques();
[[nodiscard]] std::vector<std::string_view> technique_names(std::string_view effect);

// Chooses a technique that is in the table.
void choose_technique(std::string_view effect, std::string_view name, RenderSettings& settings);

// Why two choices exclude each other.
inline constexpr const char* kUnlikePhotons =
    "excludes another technique of photons: caustics and indirect share them";

// Whether the settings are as that choice leaves them. A later choice may have changed them: photons of
// caustics and of indirect light are the same ones.
[[nodiscard]] bool is_chosen(std::string_view effect, std::string_view name, const RenderSettings& settings);

}  // namespace voxilux
