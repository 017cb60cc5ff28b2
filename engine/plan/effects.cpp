#include "plan/effects.h"

#include "base/error.h"
#include "scene/atmosphere.h"

namespace voxilux {
namespace {

// What a row of the table decides: whether the need of the effect is met (without it the effect has no
// meaning), whether the scene calls for it, and whether the image would be different with it although it is
// left out.
struct Verdict {
    bool possible = false;
    bool called_for = false;
    std::string reason;
    bool by_choice = false;
};

struct EffectRow {
    Effect effect;
    std::string_view name;
    Verdict (*verdict)(const SceneFacts&, const EffectRequest&);
};

Verdict verdict_of_lens(const SceneFacts& facts, const EffectRequest& request) {
    if (!request.is_perspective) return {false, false, "the camera's projection has no lens"};
    if (!(facts.aperture > 0.0)) return {false, false, "the camera is a pinhole"};
    return {true, true, fmt::format("an aperture of {:.6g} voxels", facts.aperture)};
}

Verdict verdict_of_voxels(const SceneFacts& facts, const EffectRequest&) {
    if (!facts.has_voxels) return {false, false, "the scene has no voxels"};
    return {true, true, fmt::format("{} voxels", facts.voxel_count)};
}

Verdict verdict_of_spheres(const SceneFacts& facts, const EffectRequest&) {
    if (!facts.has_spheres) return {false, false, "the scene has no analytic spheres"};
    if (facts.sphere_count == 0) return {true, true, "the ground"};
    const char* ground = facts.has_ground ? " and the ground" : "";
    return {true, true, fmt::format("{} analytic spheres{}", facts.sphere_count, ground)};
}

Verdict verdict_of_ao(const SceneFacts& facts, const EffectRequest&) {
    if (!facts.has_voxels && !facts.has_spheres) return {false, false, "nothing casts or receives occlusion"};
    if (!facts.has_sky) return {true, false, "the sky is black: there is no light to occlude"};
    return {true, true, "surfaces see the sky"};
}

Verdict verdict_of_sun(const SceneFacts& facts, const EffectRequest&) {
    if (!facts.sun_reaches) return {false, false, "the sun is off, black or not above the horizon"};
    if (!facts.has_voxels && !facts.has_spheres) return {false, false, "there is nothing to light"};
    return {true, true, "the sun is above the horizon"};
}

Verdict verdict_of_sky(const SceneFacts& facts, const EffectRequest&) {
    if (!facts.has_sky && facts.has_atmosphere) return {false, false, "the atmosphere has no sun"};
    if (!facts.has_sky) return {false, false, "the sky is black"};
    if (facts.sky_image.x != 0)
        return {true, true, fmt::format("an image of {} x {} texels", facts.sky_image.x, facts.sky_image.y)};
    return {true, true, facts.has_atmosphere ? "an atmosphere scatters sunlight" : "constant sky radiance"};
}

Verdict verdict_of_aerial(const SceneFacts& facts, const EffectRequest&) {
    if (!facts.has_atmosphere) return {false, false, "the sky is no atmosphere"};
    if (!facts.has_sky) return {false, false, "the atmosphere has no sun"};
    if (!facts.has_voxels && !facts.has_spheres) return {false, false, "nothing is seen through the air"};
    const float percent = 100.0f * facts.haze;
    const std::string share =
        percent < 10.0f ? fmt::format("{:.2g}", percent) : fmt::format("{:.0f}", percent);
    const std::string takes =
        fmt::format("the air before the farthest surface takes {} % of its light", share);
    if (facts.haze < kVisibleHaze) return {true, false, takes + ", which nobody sees"};
    return {true, true, takes};
}

Verdict verdict_of_emission(const SceneFacts& facts, const EffectRequest&) {
    if (!facts.has_emitters) return {false, false, "no used material emits"};
    return {true, true, "emissive materials are seen directly"};
}

Verdict verdict_of_specular(const SceneFacts& facts, const EffectRequest& request) {
    const bool shows_rough = facts.has_rough && request.traces_rough;
    if (shows_rough && !facts.has_sharp) return {true, true, "camera rays end at rough metal or glass"};
    if (!facts.has_glass && !facts.has_metal) return {false, false, "no used material is glass or mirror"};
    return {true, true,
            fmt::format("camera rays follow {}", facts.has_glass && facts.has_metal ? "mirrors and glass"
                                                 : facts.has_glass                  ? "glass"
                                                                                    : "mirrors")};
}

Verdict verdict_of_direct(const SceneFacts& facts, const EffectRequest&) {
    if (!facts.has_emitters) return {false, false, "no used material emits"};
    return {true, true, "emitters light surfaces"};
}

Verdict verdict_of_caustics(const SceneFacts& facts, const EffectRequest& request) {
    if (facts.has_rough && request.traces_rough && !facts.has_sharp)
        return {false, false, "glass and metal are rough: they light surfaces as diffuse ones do"};
    if (!facts.has_glass && !facts.has_metal)
        return {false, false, "neither glass nor mirror is in the light's way"};
    if (!facts.has_emitters && !facts.sun_reaches) return {false, false, "neither emitter nor sun shines"};
    return {true, true, "glass and mirrors gather light"};
}

Verdict verdict_of_indirect(const SceneFacts& facts, const EffectRequest& request) {
    if (!facts.has_voxels && !facts.has_spheres) return {false, false, "there is nothing to light"};
    const bool shines = facts.has_emitters || facts.sun_reaches;
    if (!shines && !request.traces_paths) return {false, false, "neither emitter nor sun shines"};
    if (!shines && !facts.has_sky) return {false, false, "neither emitter nor sun nor sky shines"};
    if (!facts.has_reflectors) return {true, false, "no surface reflects light"};
    if (request.wants_occlusion)
        return {true, false, "occlusion is asked for, which stands for light between surfaces", true};
    return {true, true, "surfaces send light on"};
}

Verdict verdict_of_aov(const SceneFacts&, const EffectRequest& request) {
    if (!request.wants_aov) return {true, false, "the output holds colour only"};
    return {true, true, "the output is an EXR"};
}

constexpr std::array<EffectRow, kEffectCount> kEffects = {{
    {Effect::lens, "lens", verdict_of_lens},
    {Effect::voxels, "voxels", verdict_of_voxels},
    {Effect::spheres, "spheres", verdict_of_spheres},
    {Effect::specular, "specular", verdict_of_specular},
    {Effect::ao, "ao", verdict_of_ao},
    {Effect::sun, "sun", verdict_of_sun},
    {Effect::sky, "sky", verdict_of_sky},
    {Effect::aerial, "aerial", verdict_of_aerial},
    {Effect::emission, "emission", verdict_of_emission},
    {Effect::direct, "direct", verdict_of_direct},
    {Effect::caustics, "caustics", verdict_of_caustics},
    {Effect::indirect, "indirect", verdict_of_indirect},
    {Effect::aov, "aov", verdict_of_aov},
}};

EffectState decide(const EffectRow& row, const SceneFacts& facts, const EffectRequest& request) {
    const Verdict verdict = row.verdict(facts, request);
    const auto asked = request.switches.find(row.effect);
    const Switch choice = asked == request.switches.end() ? Switch::automatic : asked->second;
    if (choice == Switch::off && verdict.possible)
        return {row.effect, false, fmt::format("switched off by the user ({})", verdict.reason),
                verdict.called_for || verdict.by_choice};
    if (choice == Switch::on && verdict.possible && !verdict.called_for)
        return {row.effect, true, fmt::format("switched on by the user, though {}", verdict.reason)};
    return {row.effect, verdict.possible && verdict.called_for, verdict.reason, verdict.by_choice};
}

// Light that has not been let out, or finds no mirror, needs no photons, and without a sky there is no air.
void drop_unlit(const EffectRequest& request, EffectStates& states) {
    const auto state = [&](Effect effect) -> EffectState& {
        return states[static_cast<std::size_t>(effect)];
    };
    const auto drop = [&](Effect effect, const char* reason) {
        if (state(effect).on) state(effect) = {effect, false, reason, true};
    };
    if (!state(Effect::sky).on) drop(Effect::aerial, "the sky is switched off");
    if (!state(Effect::specular).on) drop(Effect::caustics, "mirrors and glass are switched off");
    const bool sky_lights = request.traces_paths && state(Effect::sky).on;
    if (state(Effect::emission).on) return;
    drop(Effect::direct, "emitters are switched off");
    if (state(Effect::sun).on) return;
    drop(Effect::caustics, "neither emitter nor sun shines");
    if (!sky_lights) drop(Effect::indirect, "neither emitter nor sun shines");
}

// Occlusion within a reach is a stand-in for the light of the sky, which paths find as it is. It stays on
// where the user asks for it, as an AOV.
void drop_stand_in(const EffectRequest& request, EffectStates& states) {
    const bool is_asked_for = request.switches.contains(Effect::ao);
    EffectState& ao = states[static_cast<std::size_t>(Effect::ao)];
    if (!request.traces_paths || !states[static_cast<std::size_t>(Effect::indirect)].on) return;
    if (ao.on && !is_asked_for)
        ao = {Effect::ao, false, "paths find the light of the sky without a stand-in"};
}

}  // namespace

std::string_view name_of(Effect effect) {
    return kEffects[static_cast<std::size_t>(effect)].name;
}

Effect effect_named(std::string_view name) {
    std::string known;
    for (const EffectRow& row : kEffects) {
        if (row.name == name) return row.effect;
        known += known.empty() ? "" : ", ";
        known += row.name;
    }
    throw Error(ExitCode::usage, fmt::format("--effect: there is no effect '{}'; known are {}", name, known));
}

EffectStates decide_effects(const SceneFacts& facts, const EffectRequest& request) {
    EffectStates states;
    for (std::size_t i = 0; i < kEffectCount; ++i)
        states[i] = decide(kEffects[i], facts, request);
    drop_unlit(request, states);
    drop_stand_in(request, states);
    return states;
}

}  // namespace voxilux
