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
             "paths from the camera aim at the sun's images in voxels, and meet the rest by chance"),
    none(Effect::caustics),
    gathering(Effect::indirect),
    splatting(Effect::indirect),
    pixel_radii(Effect::indirect),
    paths_of(Effect::indirect, "paths",
             "paths from surface to surface find all light, that of the sky included: unbiased"),
    paths_of(Effect::indirect, "reference", "the same, but paths meet emitters by chance alone: slower"),
    none(Effect::indirect),
    Technique{.effect = Effect::sky,
              .name = "tables",
              .sentence = "tables of the light in the air, built once for a sun",
              .biased = true},
    Technique{.effect = Effect::sky,
              .name = "reference",
              .sentence = "a path through the air for each ray that leaves the scene: unbiased, and slow"},
};

const Technique* technique_named(Effect effect, std::string_view name) {
    const auto row = std::ranges::find_if(
        kTechniques, [&](const Technique& one) { return one.effect == effect && one.name == name; });
    VX_ASSERT(row != kTechniques.end());
    return &*row;
}

// Whether the settings name a technique of photons that is not the default.
bool names_photons(const PhotonSettings& photons) {
    return photons.scatter || photons.classic;
}

// Where emitters are all the light, and photons find their caustics anyway, photons take half to a quarter of
// the time of paths to an equal error (lab/notes/paths.md).
bool favours_photons(const EffectStates& effects, const PathSettings& paths) {
    const auto is_on = [&](Effect effect) { return effects[static_cast<std::size_t>(effect)].on; };
    return is_on(Effect::caustics) && is_on(Effect::emission) && !is_on(Effect::sun) && !is_on(Effect::sky) &&
           !paths.caustics.value_or(false);
}

bool traces_paths(const EffectStates& effects, const RenderSettings& settings) {
    return settings.paths.indirect.value_or(!names_photons(settings.photons) &&
                                            !favours_photons(effects, settings.paths));
}

// Whether the settings leave all light to paths.
bool may_trace_all(const RenderSettings& settings) {
    return settings.paths.indirect.value_or(!names_photons(settings.photons)) &&
           settings.paths.caustics.value_or(true);
}

ChosenTechnique way_of_photons(Effect effect, const PhotonSettings& settings, const char* reason) {
    if (settings.scatter) return {technique_named(effect, "splatting"), "asked for"};
    if (settings.classic) return {technique_named(effect, "pixel_radii"), "asked for"};
    return {technique_named(effect, "photons"), reason};
}

ChosenTechnique way_of_indirect(const EffectStates& effects, const RenderSettings& settings, bool has_rough) {
    const PathSettings& paths = settings.paths;
    if (!paths.indirect && shows_rough(effects, settings, has_rough))
        return {technique_named(Effect::indirect, "paths"), "nothing else shows rough metal and glass"};
    if (!traces_paths(effects, settings))
        return way_of_photons(
            Effect::indirect, settings.photons,
            paths.indirect ? "asked for" : "emitters are all the light, and send photons anyway");
    return {technique_named(Effect::indirect, paths.plain ? "reference" : "paths"),
            paths.indirect ? "asked for" : "unbiased, and the fastest way to an equal error"};
}

ChosenTechnique way_of_caustics(const EffectStates& effects, const RenderSettings& settings,
                                bool has_specular_spheres, bool has_rough) {
    const auto paths = [](const char* reason) {
        return ChosenTechnique{technique_named(Effect::caustics, "paths"), reason};
    };
    if (settings.paths.caustics.value_or(false)) return paths("asked for");
    if (shows_rough(effects, settings, has_rough)) return paths("they show rough metal and glass, too");
    const bool is_open = !settings.paths.caustics;
    if (is_open && settings.paths.plain && traces_paths(effects, settings))
        return paths("plain paths find all light");
    if (!leaves_sun_to_paths(effects, settings, has_specular_spheres))
        return way_of_photons(Effect::caustics, settings.photons,
                              is_open ? "the fastest way, whose error is known" : "asked for");
    if (effects[static_cast<std::size_t>(Effect::emission)].on)
        return way_of_photons(Effect::caustics, settings.photons,
                              "the fastest way for emitters; the sun is left to paths, since voxels alone "
                              "send it on");
    return paths("voxels alone send sunlight on, in directions that paths know");
}

}  // namespace

std::span<const Technique> all_techniques() {
    return kTechniques;
}

bool leaves_sun_to_paths(const EffectStates& effects, const RenderSettings& settings,
                         bool has_specular_spheres) {
    return effects[static_cast<std::size_t>(Effect::indirect)].on && traces_paths(effects, settings) &&
           !settings.paths.caustics && !names_photons(settings.photons) && !has_specular_spheres;
}

bool shows_rough(const EffectStates& effects, const RenderSettings& settings, bool has_rough) {
    const auto is_on = [&](Effect effect) { return effects[static_cast<std::size_t>(effect)].on; };
    return has_rough && is_on(Effect::specular) && is_on(Effect::indirect) && may_trace_all(settings);
}

std::vector<ChosenTechnique> choose_techniques(const EffectStates& effects, const AoPlan& ao,
                                               const RenderSettings& settings, bool has_specular_spheres,
                                               bool has_rough) {
    std::vector<ChosenTechnique> chosen;
    if (effects[static_cast<std::size_t>(Effect::ao)].on)
        chosen.push_back({technique_named(Effect::ao, ao.uses_cells() ? "hash" : "brute"), ao.reason});
    const auto add = [&](Effect effect, const auto& way) {
        const EffectState& state = effects[static_cast<std::size_t>(effect)];
        chosen.push_back(state.on ? way() : ChosenTechnique{technique_named(effect, "none"), state.reason});
    };
    add(Effect::caustics,
        [&] { return way_of_caustics(effects, settings, has_specular_spheres, has_rough); });
    add(Effect::indirect, [&] { return way_of_indirect(effects, settings, has_rough); });
    return chosen;
}

ChosenTechnique choose_sky_technique(const RenderSettings& settings) {
    if (settings.traces_air) return {technique_named(Effect::sky, "reference"), "asked for"};
    return {technique_named(Effect::sky, "tables"), "within 3 % of the truth by day, and much faster"};
}

EffectRequest with_techniques(EffectRequest request, const RenderSettings& settings) {
    const auto leave_out = [&](Effect effect, bool is_found) {
        Switch& choice = request.switches[effect];
        if (!is_found && choice == Switch::automatic) choice = Switch::off;
    };
    request.traces_paths = settings.paths.indirect.value_or(!names_photons(settings.photons));
    request.wants_occlusion = settings.ao.method != AoMethod::automatic && !settings.paths.indirect &&
                              !names_photons(settings.photons);
    leave_out(Effect::caustics, settings.photons.caustics);
    leave_out(Effect::indirect, settings.photons.indirect);
    const auto is_off = [&](Effect effect) { return request.switches[effect] == Switch::off; };
    request.traces_rough = may_trace_all(settings) && !request.wants_occlusion && !is_off(Effect::specular) &&
                           !is_off(Effect::indirect);
    return request;
}

}  // namespace voxilux
