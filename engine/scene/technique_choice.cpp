#include "scene/technique_choice.h"

#include <algorithm>
#include <array>
#include <optional>

#include "base/assert.h"

namespace voxilux {
namespace {

template <AoMethod kMethod>
void choose_ao(RenderSettings& settings) {
    settings.ao.method = kMethod;
}

// Which members of the settings say how an effect is found.
struct FoundBy {
    bool PhotonSettings::*found;  // at all
    std::optional<bool> PathSettings::*paths;
};

template <FoundBy kBy, bool kScatter, bool kClassic>
void choose_photons(RenderSettings& settings) {
    settings.photons.*kBy.found = true;
    settings.paths.*kBy.paths = false;
    settings.photons.scatter = kScatter;
    settings.photons.classic = kClassic;
}

template <FoundBy kBy>
void choose_paths(RenderSettings& settings) {
    settings.photons.*kBy.found = true;
    settings.paths.*kBy.paths = true;
}

template <FoundBy kBy>
void leave_to_plan(RenderSettings& settings) {
    settings.photons.*kBy.found = true;
    settings.paths.*kBy.paths = std::nullopt;
}

template <FoundBy kBy>
void choose_none(RenderSettings& settings) {
    settings.photons.*kBy.found = false;
}

constexpr FoundBy kCaustics{&PhotonSettings::caustics, &PathSettings::caustics};
constexpr FoundBy kIndirect{&PhotonSettings::indirect, &PathSettings::indirect};

template <bool kPlain>
void choose_indirect_paths(RenderSettings& settings) {
    choose_paths<kIndirect>(settings);
    settings.paths.plain = kPlain;
}

template <bool kTraced>
void choose_sky(RenderSettings& settings) {
    settings.traces_air = kTraced;
}

constexpr std::array kChoices{
    TechniqueChoice{"ao", "auto", choose_ao<AoMethod::automatic>},
    TechniqueChoice{"ao", "brute", choose_ao<AoMethod::brute>},
    TechniqueChoice{"ao", "hash", choose_ao<AoMethod::hash>},
    TechniqueChoice{"caustics", "auto", leave_to_plan<kCaustics>},
    TechniqueChoice{"caustics", "photons", choose_photons<kCaustics, false, false>},
    TechniqueChoice{"caustics", "splatting", choose_photons<kCaustics, true, false>},
    TechniqueChoice{"caustics", "pixel_radii", choose_photons<kCaustics, false, true>},
    TechniqueChoice{"caustics", "paths", choose_paths<kCaustics>},
    TechniqueChoice{"caustics", "none", choose_none<kCaustics>},
    TechniqueChoice{"indirect", "auto", leave_to_plan<kIndirect>},
    TechniqueChoice{"indirect", "photons", choose_photons<kIndirect, false, false>},
    TechniqueChoice{"indirect", "splatting", choose_photons<kIndirect, true, false>},
    TechniqueChoice{"indirect", "pixel_radii", choose_photons<kIndirect, false, true>},
    TechniqueChoice{"indirect", "paths", choose_indirect_paths<false>},
    TechniqueChoice{"indirect", "reference", choose_indirect_paths<true>},
    TechniqueChoice{"indirect", "none", choose_none<kIndirect>},
    TechniqueChoice{"sky", "tables", choose_sky<false>},
    TechniqueChoice{"sky", "reference", choose_sky<true>},
};

}  // namespace

std::span<const TechniqueChoice> technique_choices() {
    return kChoices;
}

std::vector<std::string_view> effects_with_techniques() {
    std::vector<std::string_view> effects;
    for (const TechniqueChoice& row : kChoices)
        if (effects.empty() || effects.back() != row.effect) effects.push_back(row.effect);
    return effects;
}

std::vector<std::string_view> technique_names(std::string_view effect) {
    std::vector<std::string_view> names;
    for (const TechniqueChoice& row : kChoices)
        if (row.effect == effect) names.push_back(row.name);
    return names;
}

void choose_technique(std::string_view effect, std::string_view name, RenderSettings& settings) {
    const auto row = std::ranges::find_if(
        kChoices, [&](const TechniqueChoice& one) { return one.effect == effect && one.name == name; });
    VX_ASSERT(row != kChoices.end());
    row->choose(settings);
}

bool is_chosen(std::string_view effect, std::string_view name, const RenderSettings& settings) {
    RenderSettings again = settings;
    choose_technique(effect, name, again);
    return again == settings;
}

}  // namespace voxilux
