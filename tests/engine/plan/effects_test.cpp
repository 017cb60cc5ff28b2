#include <gtest/gtest.h>

#include "base/error.h"
#include "plan/effects.h"

namespace voxilux {
namespace {

// A scene that calls for everything.
SceneFacts rich() {
    SceneFacts facts;
    facts.voxel_count = 7;
    facts.sphere_count = 2;
    facts.has_voxels = facts.has_spheres = facts.sun_reaches = facts.has_sky = facts.has_emitters = true;
    facts.has_glass = facts.has_metal = facts.has_reflectors = true;
    facts.aperture = 2.5;
    return facts;
}

SceneFacts without(bool SceneFacts::*need) {
    SceneFacts facts = rich();
    facts.*need = false;
    return facts;
}

SceneFacts in_air(float haze) {
    SceneFacts facts = rich();
    facts.has_atmosphere = true;
    facts.haze = haze;
    return facts;
}

SceneFacts under_image() {
    SceneFacts facts = rich();
    facts.sky_image = {16, 8};
    return facts;
}

SceneFacts without_surfaces() {
    SceneFacts facts = without(&SceneFacts::has_voxels);
    facts.has_spheres = false;
    return facts;
}

SceneFacts without_polish() {
    SceneFacts facts = without(&SceneFacts::has_glass);
    facts.has_metal = false;
    return facts;
}

// Rough metal and rough glass, with or without a smooth one.
SceneFacts rough(bool has_sharp) {
    SceneFacts facts = rich();
    facts.has_rough = true;
    facts.has_sharp = has_sharp;
    return facts;
}

SceneFacts without_light() {
    SceneFacts facts = without(&SceneFacts::has_emitters);
    facts.sun_reaches = false;
    return facts;
}

SceneFacts without_any_light() {
    SceneFacts facts = without_light();
    facts.has_sky = false;
    return facts;
}

EffectState state(Effect effect, const SceneFacts& facts, Switch choice = Switch::automatic,
                  bool wants_aov = true) {
    EffectRequest request{.wants_aov = wants_aov};
    if (choice != Switch::automatic) request.switches[effect] = choice;
    return decide_effects(facts, request)[static_cast<std::size_t>(effect)];
}

struct Row {
    std::string name;
    EffectState got;
    bool on;
    std::string reason;
};

TEST(Effects, every_row_gives_its_reason) {
    const std::vector<Row> rows = {
        {"lens needed", state(Effect::lens, rich()), true, "an aperture of 2.5 voxels"},
        {"lens", state(Effect::lens, SceneFacts{}), false, "the camera is a pinhole"},
        {"lens of parallel rays", decide_effects(rich(), {.is_perspective = false})[0], false,
         "the camera's projection has no lens"},
        {"voxels needed", state(Effect::voxels, rich()), true, "7 voxels"},
        {"voxels", state(Effect::voxels, without(&SceneFacts::has_voxels)), false, "the scene has no voxels"},
        {"spheres needed", state(Effect::spheres, rich()), true, "2 analytic spheres"},
        {"spheres", state(Effect::spheres, without(&SceneFacts::has_spheres)), false,
         "the scene has no analytic spheres"},
        {"ao needed", state(Effect::ao, without(&SceneFacts::has_reflectors)), true, "surfaces see the sky"},
        {"ao black", state(Effect::ao, without(&SceneFacts::has_sky)), false,
         "the sky is black: there is no light to occlude"},
        {"ao nothing", state(Effect::ao, without_surfaces()), false, "nothing casts or receives occlusion"},
        {"sun needed", state(Effect::sun, rich()), true, "the sun is above the horizon"},
        {"sun out", state(Effect::sun, without(&SceneFacts::sun_reaches)), false,
         "the sun is off, black or not above the horizon"},
        {"sun nothing", state(Effect::sun, without_surfaces()), false, "there is nothing to light"},
        {"sky needed", state(Effect::sky, rich()), true, "constant sky radiance"},
        {"sky image", state(Effect::sky, under_image()), true, "an image of 16 x 8 texels"},
        {"sky", state(Effect::sky, without(&SceneFacts::has_sky)), false, "the sky is black"},
        {"aerial needed", state(Effect::aerial, in_air(0.001f)), true,
         "the air before the farthest surface takes 0.1 % of its light"},
        {"aerial thin", state(Effect::aerial, in_air(0.0009f)), false,
         "the air before the farthest surface takes 0.09 % of its light, which nobody sees"},
        {"aerial", state(Effect::aerial, rich()), false, "the sky is no atmosphere"},
        {"emission needed", state(Effect::emission, rich()), true, "emissive materials are seen directly"},
        {"emission", state(Effect::emission, without(&SceneFacts::has_emitters)), false,
         "no used material emits"},
        {"specular needed", state(Effect::specular, rich()), true, "camera rays follow mirrors and glass"},
        {"specular glass", state(Effect::specular, without(&SceneFacts::has_metal)), true,
         "camera rays follow glass"},
        {"specular mirror", state(Effect::specular, without(&SceneFacts::has_glass)), true,
         "camera rays follow mirrors"},
        {"specular", state(Effect::specular, without_polish()), false, "no used material is glass or mirror"},
        {"specular rough", state(Effect::specular, rough(false)), true,
         "camera rays end at rough metal or glass"},
        {"specular both", state(Effect::specular, rough(true)), true, "camera rays follow mirrors and glass"},
        {"direct needed", state(Effect::direct, rich()), true, "emitters light surfaces"},
        {"direct", state(Effect::direct, without(&SceneFacts::has_emitters)), false,
         "no used material emits"},
        {"caustics needed", state(Effect::caustics, rich()), true, "glass and mirrors gather light"},
        {"caustics of the sun", state(Effect::caustics, without(&SceneFacts::has_emitters)), true,
         "glass and mirrors gather light"},
        {"caustics diffuse", state(Effect::caustics, without_polish()), false,
         "neither glass nor mirror is in the light's way"},
        {"caustics rough", state(Effect::caustics, rough(false)), false,
         "glass and metal are rough: they light surfaces as diffuse ones do"},
        {"caustics of stand-ins", decide_effects(rough(false), {.traces_rough = false})[10], true,
         "glass and mirrors gather light"},
        {"caustics both", state(Effect::caustics, rough(true)), true, "glass and mirrors gather light"},
        {"caustics dark", state(Effect::caustics, without_light()), false, "neither emitter nor sun shines"},
        {"indirect needed", state(Effect::indirect, rich()), true, "surfaces send light on"},
        {"indirect of the sky", state(Effect::indirect, without_light()), true, "surfaces send light on"},
        {"indirect dark", state(Effect::indirect, without_any_light()), false,
         "neither emitter nor sun nor sky shines"},
        {"indirect black", state(Effect::indirect, without(&SceneFacts::has_reflectors)), false,
         "no surface reflects light"},
        {"indirect nothing", state(Effect::indirect, without_surfaces()), false, "there is nothing to light"},
        {"ao beside paths", state(Effect::ao, rich()), false,
         "paths find the light of the sky without a stand-in"},
        {"aov needed", state(Effect::aov, rich()), true, "the output is an EXR"},
        {"aov", state(Effect::aov, rich(), Switch::automatic, false), false, "the output holds colour only"},
    };
    for (const Row& row : rows) {
        EXPECT_EQ(row.got.on, row.on) << row.name;
        EXPECT_EQ(row.got.reason, row.reason) << row.name;
    }
}

TEST(Effects, rows_are_in_the_order_of_the_enumerators) {
    const EffectStates states = decide_effects(rich(), {});
    for (std::size_t i = 0; i < kEffectCount; ++i) {
        EXPECT_EQ(states[i].effect, static_cast<Effect>(i));
        EXPECT_EQ(effect_named(name_of(static_cast<Effect>(i))), static_cast<Effect>(i));
    }
}

TEST(Effects, needed_effect_switched_off_says_who_did_it_and_what_it_was_for) {
    const EffectState ao = state(Effect::ao, without(&SceneFacts::has_reflectors), Switch::off);
    EXPECT_FALSE(ao.on);
    EXPECT_EQ(ao.reason, "switched off by the user (surfaces see the sky)");
}

TEST(Effects, unneeded_effect_switched_on_runs_and_says_so) {
    const EffectState ao = state(Effect::ao, without(&SceneFacts::has_sky), Switch::on);
    EXPECT_TRUE(ao.on);
    EXPECT_EQ(ao.reason, "switched on by the user, though the sky is black: there is no light to occlude");
}

// Naming a technique of occlusion makes it stand in for light between surfaces. Photons do not start from the
// sky.
TEST(Effects, indirect_light_is_left_out_where_occlusion_or_photons_without_a_light_are_asked_for) {
    const auto indirect = [](const SceneFacts& facts, const EffectRequest& request) {
        return decide_effects(facts, request)[static_cast<std::size_t>(Effect::indirect)];
    };
    const EffectState stood_for = indirect(rich(), {.wants_occlusion = true});
    EXPECT_FALSE(stood_for.on);
    EXPECT_TRUE(stood_for.by_choice);
    EXPECT_EQ(stood_for.reason, "occlusion is asked for, which stands for light between surfaces");
    EXPECT_TRUE(indirect(rich(), {.switches = {{Effect::indirect, Switch::on}}, .wants_occlusion = true}).on);
    EXPECT_TRUE(indirect(without(&SceneFacts::has_emitters), {.traces_paths = false}).on) << "of the sun";
    EXPECT_EQ(indirect(without_light(), {.traces_paths = false}).reason, "neither emitter nor sun shines");
}

// Without light that surfaces send on, no photons are needed, whatever the scene has.
TEST(Effects, photons_need_emitters_or_sun_that_are_on) {
    const auto all_off = [](std::initializer_list<Effect> off) {
        EffectRequest request;
        for (const Effect effect : off)
            request.switches[effect] = Switch::off;
        return decide_effects(rich(), request);
    };
    const auto get = [](const EffectStates& states, Effect effect) {
        return states[static_cast<std::size_t>(effect)];
    };
    const EffectStates sunny = all_off({Effect::emission});
    EXPECT_FALSE(get(sunny, Effect::direct).on);
    EXPECT_TRUE(get(sunny, Effect::caustics).on);
    EXPECT_TRUE(get(sunny, Effect::indirect).on);
    const EffectStates dark = all_off({Effect::emission, Effect::sun});
    EXPECT_EQ(get(dark, Effect::direct).reason, "emitters are switched off");
    EXPECT_EQ(get(dark, Effect::caustics).reason, "neither emitter nor sun shines");
    EXPECT_TRUE(get(dark, Effect::indirect).on) << "by the sky";
    const EffectStates dull = all_off({Effect::specular});
    EXPECT_EQ(get(dull, Effect::caustics).reason, "mirrors and glass are switched off");
    EXPECT_TRUE(get(dull, Effect::indirect).on);
}

TEST(Effects, air_is_not_seen_where_the_sky_is_switched_off) {
    const EffectRequest request{.switches = {{Effect::sky, Switch::off}}};
    const EffectState air = decide_effects(in_air(0.5f), request)[static_cast<std::size_t>(Effect::aerial)];
    EXPECT_FALSE(air.on);
    EXPECT_TRUE(air.by_choice);
}

TEST(Effects, impossible_effect_cannot_be_switched_on) {
    const SceneFacts nothing;
    for (std::size_t i = 0; i < kEffectCount; ++i) {
        const auto effect = static_cast<Effect>(i);
        if (effect == Effect::aov) continue;  // always possible
        EXPECT_EQ(state(effect, nothing, Switch::on), state(effect, nothing)) << name_of(effect);
        EXPECT_FALSE(state(effect, nothing, Switch::on).on) << name_of(effect);
    }
}

TEST(Effects, impossible_effect_switched_off_keeps_the_scene_as_its_reason) {
    EXPECT_EQ(state(Effect::voxels, SceneFacts{}, Switch::off).reason, "the scene has no voxels");
}

TEST(Effects, unknown_effect_is_a_usage_error_that_names_the_known_ones) {
    try {
        (void)effect_named("shadows");
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
        EXPECT_STREQ(error.what(),
                     "--effect: there is no effect 'shadows'; known are lens, voxels, spheres, specular, ao, "
                     "sun, sky, "
                     "aerial, emission, direct, caustics, indirect, aov");
    }
}

}  // namespace
}  // namespace voxilux
