// Which technique computes an effect: the table, its names in files and flags, and what its properties
// promise.

#include "plan/techniques.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "base/error.h"
#include "engine/plan/plan_scenes.h"
#include "formats/scene_toml.h"
#include "jobs/report.h"
#include "scene/technique_choice.h"

namespace voxilux {
namespace {

// A scene with both techniques of photons and occlusion of voxels; overrides as -D gives them.
RenderPlan plan_with(std::vector<std::string> overrides, const PlanRequest& request = test::exr_request()) {
    overrides.emplace_back("render.spp=4");
    const auto is_sky = [](const std::string& one) { return one.starts_with("technique.sky="); };
    if (std::ranges::any_of(overrides, is_sky)) overrides.emplace_back("sky.model=atmosphere");
    return test::plan_of(test::repository_scene("emitters", overrides), request);
}

std::string override_of(const Technique& technique) {
    return fmt::format("technique.{}={}", name_of(technique.effect), technique.name);
}

std::map<std::string, std::string> chosen_by(const RenderPlan& plan) {
    std::map<std::string, std::string> chosen;
    for (const auto& [technique, reason] : plan.techniques) {
        EXPECT_FALSE(reason.empty());
        chosen.emplace(name_of(technique->effect), technique->name);
    }
    return chosen;
}

const Technique& chosen_of(const RenderPlan& plan, Effect effect) {
    const auto found = std::ranges::find_if(
        plan.techniques, [&](const ChosenTechnique& chosen) { return chosen.technique->effect == effect; });
    VX_ASSERT(found != plan.techniques.end());
    return *found->technique;
}

TEST(Techniques, files_and_flags_name_each_row_of_the_table) {
    std::vector<std::string> rows, names;
    for (const Technique& technique : all_techniques())
        rows.push_back(override_of(technique));
    for (const TechniqueChoice& choice : technique_choices())
        if (choice.name != "auto")
            names.push_back(fmt::format("technique.{}={}", choice.effect, choice.name));
    EXPECT_EQ(rows, names);
}

TEST(Techniques, technique_that_a_file_names_is_the_one_of_the_plan) {
    for (const Technique& technique : all_techniques()) {
        if (technique.effect == Effect::caustics) continue;  // the scene has neither mirror nor glass
        const RenderPlan plan = plan_with({override_of(technique)});
        EXPECT_EQ(&chosen_of(plan, technique.effect), &technique) << override_of(technique);
    }
    const RenderPlan glass =
        test::plan_of(test::repository_scene("cornell", {"technique.caustics=splatting"}), {});
    EXPECT_EQ(chosen_by(glass),
              (std::map<std::string, std::string>{{"caustics", "splatting"}, {"indirect", "splatting"}}))
        << "photons are shared";
}

TEST(Techniques, older_keys_are_other_names_of_the_same_choice) {
    const std::map<std::string, std::string> same = {
        {"technique.ao=hash", "ao.method=hash"},
        {"technique.ao=brute", "ao.method=brute"},
        {"technique.ao=auto", "ao.method=auto"},
        {"technique.indirect=splatting", "photons.scatter=true"},
        {"technique.indirect=pixel_radii", "photons.classic=true"},
        {"technique.indirect=photons", "paths.indirect=false"},
        {"technique.indirect=auto", "photons.scatter=false"},
        {"technique.indirect=paths", "paths.indirect=true"}};
    for (const auto& [technique, older] : same)
        EXPECT_EQ(describe(plan_with({technique})), describe(plan_with({older}))) << technique;
    EXPECT_NE(plan_with({"technique.ao=hash"}), plan_with({"technique.ao=brute"}));
}

// `none` is the effect switched off, unless the user has it on.
TEST(Techniques, none_leaves_the_effect_out) {
    const RenderPlan none = plan_with({"technique.indirect=none"});
    EXPECT_FALSE(none.has(Effect::indirect));
    EXPECT_FALSE(none.photons.runs());
    const RenderPlan off =
        plan_with({}, test::with_switch(test::exr_request(), Effect::indirect, Switch::off));
    EXPECT_EQ(footprint(none), footprint(off));
    EXPECT_EQ(chosen_by(none), chosen_by(off));
    const RenderPlan on = plan_with({"technique.indirect=none"},
                                    test::with_switch(test::exr_request(), Effect::indirect, Switch::on));
    EXPECT_EQ(chosen_of(on, Effect::indirect).name, "paths");
}

// Paths find the light of the sky, so its stand-in is not needed; sky and sun alone call for paths.
TEST(Techniques, paths_take_the_place_of_occlusion_and_photons) {
    const Scene scene = test::repository_scene("first_light");
    const RenderPlan plan = test::plan_of(scene, {});
    EXPECT_TRUE(plan.is_by_paths(Effect::indirect));
    EXPECT_FALSE(plan.has(Effect::ao));
    EXPECT_FALSE(plan.photons.runs());
    EXPECT_TRUE(test::plan_of(scene, test::with_switch({}, Effect::ao, Switch::on)).has(Effect::ao))
        << "as an AOV";
    const RenderPlan off = test::plan_of(scene, test::with_switch({}, Effect::indirect, Switch::off));
    EXPECT_TRUE(off.has(Effect::ao));
    EXPECT_FALSE(off.paths.runs());
}

TEST(Techniques, photons_of_caustics_and_paths_of_indirect_light_go_together) {
    const RenderPlan both =
        test::plan_of(test::repository_scene("cornell", {"technique.indirect=paths"}), {});
    EXPECT_TRUE(both.photons.runs());
    EXPECT_TRUE(both.paths.runs());
    EXPECT_EQ(chosen_by(both),
              (std::map<std::string, std::string>{{"caustics", "photons"}, {"indirect", "paths"}}));
    const RenderPlan paths = test::plan_of(
        test::repository_scene("cornell", {"technique.indirect=paths", "technique.caustics=paths"}), {});
    EXPECT_FALSE(paths.photons.runs());
    EXPECT_THROW((void)test::plan_of(test::repository_scene("cornell", {"technique.caustics=paths",
                                                                        "technique.indirect=photons"}),
                                     {}),
                 Error);
}

TEST(Techniques, rough_surfaces_take_paths_for_all_light_unless_others_are_named) {
    const auto rough = [](std::vector<std::string> overrides) {
        return test::plan_of(test::repository_scene("rough", overrides), {});
    };
    const RenderPlan plan = rough({});
    EXPECT_TRUE(plan.shows_rough);
    EXPECT_FALSE(plan.photons.runs());
    EXPECT_EQ(chosen_by(plan),
              (std::map<std::string, std::string>{{"caustics", "paths"}, {"indirect", "paths"}}));
    EXPECT_TRUE(rough({"sun.on=false", "sky.radiance=[0, 0, 0]"}).shows_rough) << "emitters alone";
    EXPECT_TRUE(rough({"technique.indirect=reference"}).shows_rough);
    EXPECT_TRUE(rough({"technique.caustics=none"}).shows_rough);
    for (const char* other : {"technique.caustics=photons", "technique.indirect=none", "technique.ao=hash"}) {
        const RenderPlan stand_in = rough({other});
        EXPECT_FALSE(stand_in.shows_rough) << other;
        EXPECT_TRUE(std::ranges::any_of(stand_in.notes, [](const std::string& note) {
            return note.starts_with("rough metal is shown as");
        })) << other;
    }
    EXPECT_FALSE(
        std::ranges::any_of(plan.notes, [](const std::string& note) { return note.starts_with("rough"); }));
}

std::map<std::string, std::string> chosen_in(const std::string& name,
                                             const std::vector<std::string>& overrides = {},
                                             const PlanRequest& request = {}) {
    return chosen_by(test::plan_of(test::repository_scene(name, overrides), request));
}

using Chosen = std::map<std::string, std::string>;

// Photons of caustics are used for indirect light where emitters are the only light; elsewhere paths are.
TEST(Techniques, light_of_the_scene_decides_between_paths_and_photons) {
    EXPECT_EQ(chosen_in("cornell"), (Chosen{{"caustics", "photons"}, {"indirect", "photons"}}));
    EXPECT_EQ(chosen_in("cornell", {"sky.radiance=[1, 1, 1]"}),
              (Chosen{{"caustics", "photons"}, {"indirect", "paths"}}));
    EXPECT_EQ(chosen_in("cornell", {"technique.caustics=paths"}),
              (Chosen{{"caustics", "paths"}, {"indirect", "paths"}}));
    EXPECT_EQ(chosen_in("emitters"), (Chosen{{"caustics", "none"}, {"indirect", "paths"}}));
    EXPECT_EQ(chosen_in("first_light", {"technique.ao=hash"}),
              (Chosen{{"ao", "hash"}, {"caustics", "none"}, {"indirect", "none"}}));
    EXPECT_EQ(chosen_in("mixed", {"technique.indirect=reference", "material.gold.surface=\"metal\""})
                  .at("indirect"),
              "reference");
}

// Sunlight by way of voxels comes from directions that paths know; by way of spheres it does not. Emitters do
// not change which technique finds it, so a faint emitter changes the picture only by its own light.
TEST(Techniques, caustics_of_the_sun_are_left_to_paths_where_no_sphere_is_specular) {
    const std::string voxels =
        "[material.glass]\nsurface = \"glass\"\n[[shape]]\nshape = \"box\"\n"
        "from = [0, 0, 0]\nto = [2, 2, 2]\nmaterial = \"glass\"\n";
    const std::string sphere = "[[sphere]]\ncenter = [0, 0, 5]\nradius = 1\nmaterial = \"glass\"\n";
    const std::string lamp =
        "[material.lamp]\nemission = [1e-4, 1e-4, 1e-4]\n[[sphere]]\n"
        "center = [9, 9, 9]\nradius = 1\nmaterial = \"lamp\"\n";
    const auto plan = [](const std::string& text) { return test::plan_of(parse_scene(text, "s.toml"), {}); };
    EXPECT_EQ(chosen_by(plan(voxels)), (Chosen{{"caustics", "paths"}, {"indirect", "paths"}}));
    const RenderPlan lit = plan(voxels + lamp);
    EXPECT_EQ(chosen_by(lit), (Chosen{{"caustics", "photons"}, {"indirect", "paths"}}));
    EXPECT_TRUE(lit.paths_find_sun_caustics);
    EXPECT_EQ(lit.photons.sun_photons, 0u);
    EXPECT_NE(lit.photons.emitter_photons, 0u);
    const RenderPlan round = plan(voxels + sphere);
    EXPECT_EQ(chosen_by(round), (Chosen{{"caustics", "photons"}, {"indirect", "paths"}}));
    EXPECT_FALSE(round.paths_find_sun_caustics);
    EXPECT_NE(round.photons.sun_photons, 0u);
    EXPECT_TRUE(round.sends_caustics_on());
}

// The longest paths decide how many dispatches a sample takes.
TEST(Techniques, paths_between_whiter_walls_have_more_rounds_and_fewer_of_them_in_an_invocation) {
    const DeviceLimits cpu{.is_cpu = true};
    PathPlan last = plan_paths({.max_albedo = 0.5, .has_voxels = true}, cpu);
    EXPECT_EQ(last.rounds, 1u);
    EXPECT_GT(last.per_lane, 8u);
    for (const double albedo : {0.9, 0.99, 0.999, 1.0}) {
        const PathPlan plan = plan_paths({.max_albedo = albedo, .has_voxels = true}, cpu);
        EXPECT_GE(plan.rounds, last.rounds);
        EXPECT_LE(plan.per_lane, last.per_lane);
        last = plan;
    }
    EXPECT_GT(last.rounds, 4u);
    EXPECT_LT(last.per_lane, 16u);
}

bool takes_a_shard(const Technique& technique) {
    PlanRequest request = test::exr_request();
    request.part = SampleSet::shard(0, 2, 16);
    try {
        (void)plan_with({override_of(technique)}, request);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage) << error.what();
        return false;
    }
    return true;
}

TEST(Techniques, properties_are_those_of_the_plan) {
    for (const Technique& technique : all_techniques()) {
        if (technique.effect == Effect::caustics) continue;
        SCOPED_TRACE(override_of(technique));
        const RenderPlan plan = plan_with({override_of(technique), "render.size=[1024, 1032]"});
        EXPECT_EQ(takes_a_shard(technique), technique.mergeable());
        EXPECT_EQ(plan.any(&Technique::keeps_state), !technique.mergeable());
        EXPECT_EQ(plan.film_tile_count == 1, technique.whole_frame);
        if (technique.effect != Effect::indirect) continue;
        EXPECT_EQ(plan.needs_pilot(), technique.needs_pilot);
        EXPECT_EQ(plan.has_independent_samples(), technique.independent_samples);
        EXPECT_EQ(plan.sums_bias, technique.tells_bias);
    }
}

// State that outlives a sample is a persistent buffer beside the scene and the film.
TEST(Techniques, technique_that_keeps_state_has_a_persistent_buffer_of_its_own) {
    for (const Technique& technique : all_techniques()) {
        if (technique.effect == Effect::caustics) continue;
        const Footprint needs = footprint(plan_with({override_of(technique), "photons.radius=1"}));
        const bool has_state = std::ranges::any_of(needs.buffers, [](const PlannedBuffer& planned) {
            const auto starts = [&](const char* prefix) { return planned.buffer.starts_with(prefix); };
            return planned.persistent && (starts("ao.") || starts("photon."));
        });
        EXPECT_EQ(has_state, technique.keeps_state()) << override_of(technique);
    }
}

TEST(Techniques, plan_prints_each_with_its_reason_and_properties) {
    const Scene scene =
        test::repository_scene("emitters", {"technique.ao=hash", "technique.indirect=photons"});
    const RenderPlan plan = test::plan_of(scene);
    EXPECT_NE(describe(plan).find("technique ao         hash        asked for\n"), std::string::npos)
        << describe(plan);
    const nlohmann::ordered_json rows = plan_json(scene, plan).at("techniques");
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0].at("effect"), "ao");
    EXPECT_EQ(rows[0].at("technique"), "hash");
    EXPECT_EQ(rows[0].at("reason"), "asked for");
    EXPECT_EQ(rows[0].at("mergeable"), false);
    EXPECT_EQ(rows[1].at("technique"), "none");
    EXPECT_EQ(rows[1].at("reason"), plan.effects[static_cast<std::size_t>(Effect::caustics)].reason);
    EXPECT_EQ(rows[2].at("technique"), "photons");
    for (const char* property : {"biased", "independent_samples", "needs_pilot", "mergeable"})
        EXPECT_EQ(rows[2].at(property), true) << property;
    EXPECT_EQ(rows[2].at("whole_frame"), false);
}

}  // namespace
}  // namespace voxilux
