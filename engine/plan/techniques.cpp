#include "plan/techniques.h"

#include <algorithm>
#include <array>

#include "base/assert.h"

namespace voxilux {
namespace {

// Photons of caustics and of indirect light are the same ones.
constexpr Technique photons_of(Effect effect, std::string_view name, std::string_view sentence,
                               std::string_view state = {}) {
    return {.effect = effect,
            .name = name,
            .sentence = sentence,
            .by_photons = true,
            .biased = true,
            .tells_bias = true,
            .independent_samples = true,
            .whole_tiles = true,
            .uneven_samples = true,
            .needs_pilot = true,
            .noise = NoiseLaw::photons,
            .state = state};
}

constexpr Technique gathering(Effect effect) {
    return photons_of(effect, "photons",
                      "visible points gather the photons around them, with one radius for all");
}

constexpr Technique splatting(Effect effect) {
    return photons_of(effect, "splatting",
                      "photons add themselves to the visible points around them: the same sums");
}

constexpr Technique pixel_radii(Effect effect) {
    return photons_of(effect, "pixel_radii", "visible points gather photons, each with a radius of its own",
                      "classic radii of photons depend on the samples before; use photons.classic=false");
}

constexpr Technique paths_of(Effect effect, std::string_view name, std::string_view sentence) {
    return {.effect = effect, .name = name, .sentence = sentence, .by_paths = true};
}

constexpr Technique none(Effect effect) {
    return {.effect = effect, .name = "none", .sentence = "this light is left out"};
}

constexpr std::array kTechniques{
    Technique{.effect = Effect::ao, .name = "brute", .sentence = "rays of each pixel alone"},
    Technique{.effect = Effect::ao,
              .name = "hash",
              .sentence = "rays shared in cells of the surface, which outlive a frame",
              .biased = true,
              .shares_samples = true,
              .whole_frame = true,
              .state = "pixels that share occlusion depend on the samples before; use --ao brute"},
    gathering(Effect::caustics),
    splatting(Effect::caustics),
    pixel_radii(Effect::caustics),
    paths_of(Effect::caustics, "paths",
             "paths from the camera meet light behind mirrors and glass by chance"),
    none(Effect::caustics),
    gathering(Effect::indirect),
    splatting(Effect::indirect),
    pixel_radii(Effect::indirect),
    paths_of(Effect::indirect, "paths",
             "paths from surface to surface find all light, that of the sky included: unbiased"),
    paths_of(Effect::indirect, "reference", "the same, but paths meet emitters by chance alone: slower"),
    none(Effect::indirect),
};

const Technique* technique_named(Effect effect, std::string_view name) {
    const auto row = std::ranges::find_if(
        kTechniques, [&](const Technique& one) { return one.effect == effect && one.name == name; });
    VX_ASSERT(row != kTechniques.end());
    return &*row;
}

bool is_found_by_paths(Effect effect, const PathSettings& paths) {
    return effect == Effect::indirect ? paths.indirect : effect == Effect::caustics && paths.caustics;
}

ChosenTechnique way_of_light(Effect effect, const RenderSettings& all) {
    if (is_found_by_paths(effect, all.paths)) {
        const bool is_plain = effect == Effect::indirect && all.paths.plain;
        return {technique_named(effect, is_plain ? "reference" : "paths"), "asked for"};
    }
    const PhotonSettings& settings = all.photons;
    if (settings.scatter) return {technique_named(effect, "splatting"), "asked for"};
    if (settings.classic) return {technique_named(effect, "pixel_radii"), "asked for"};
    return {technique_named(effect, "photons"), "the fastest way, whose error is known"};
}

}  // namespace

std::span<const Technique> all_techniques() {
    return kTechniques;
}

std::vector<ChosenTechnique> choose_techniques(const EffectStates& effects, const AoPlan& ao,
                                               const RenderSettings& settings) {
    std::vector<ChosenTechnique> chosen;
    if (effects[static_cast<std::size_t>(Effect::ao)].on)
        chosen.push_back({technique_named(Effect::ao, ao.uses_cells() ? "hash" : "brute"), ao.reason});
    for (const Effect effect : {Effect::caustics, Effect::indirect}) {
        const EffectState& state = effects[static_cast<std::size_t>(effect)];
        chosen.push_back(state.on ? way_of_light(effect, settings)
                                  : ChosenTechnique{technique_named(effect, "none"), state.reason});
    }
    return chosen;
}

EffectRequest with_techniques(EffectRequest request, const RenderSettings& settings) {
    const auto leave_out = [&](Effect effect, bool is_found) {
        Switch& choice = request.switches[effect];
        if (!is_found && choice == Switch::automatic) choice = Switch::off;
    };
    request.traces_paths = settings.paths.indirect;
    leave_out(Effect::caustics, settings.photons.caustics);
    leave_out(Effect::indirect, settings.photons.indirect);
    return request;
}

}  // namespace voxilux
