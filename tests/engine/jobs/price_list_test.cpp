// Parameters, runs, CSV and JSON of a price list that no device measured.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "jobs/price_list/price_list.h"
#include "jobs/price_list/reference.h"
#include "scene/technique_choice.h"

namespace voxilux {
namespace {

RenderPlan plan_with(std::initializer_list<Effect> effects) {
    RenderPlan plan;
    for (std::size_t i = 0; i < kEffectCount; ++i)
        plan.effects[i].effect = static_cast<Effect>(i);
    for (const Effect effect : effects)
        plan.effects[static_cast<std::size_t>(effect)].on = true;
    plan.techniques = choose_techniques(plan.effects, plan.ao, plan.settings, false);
    plan.settings.size = plan.image_size = {4, 3};
    plan.film_tile_rows = plan.tile_rows = 3;
    plan.film_tile_count = 1;
    plan.world.root_bytes = plan.world.node_bytes = plan.world.leaf_bytes = 4;
    plan.material_count = 1;
    return plan;
}

std::set<std::string> parameters_of(const ParameterDesign& design) {
    std::set<std::string> names;
    for (const Parameter& parameter : design.parameters)
        names.insert(parameter.name);
    return names;
}

TEST(Parameters, are_those_of_what_the_plan_uses) {
    EXPECT_EQ(parameters_of(design_parameters(plan_with({Effect::spheres}), {})),
              (std::set<std::string>{"samples", "sequence"}));
    EXPECT_EQ(parameters_of(design_parameters(plan_with({Effect::voxels, Effect::ao}), {})),
              (std::set<std::string>{"samples", "sequence", "traversal", "ao", "ao_cell", "ao_rays"}));
    RenderPlan photons = plan_with({Effect::spheres, Effect::indirect});
    photons.settings.paths.indirect = false;
    photons.techniques = choose_techniques(photons.effects, photons.ao, photons.settings, false);
    photons.photons.emitter_photons = 4096;
    photons.photons.radius = 2.0;
    EXPECT_EQ(parameters_of(design_parameters(photons, {.settings = {.photons = {.radius = 2.0}}})),
              (std::set<std::string>{"samples", "sequence", "photons", "radius", "alpha", "gather", "paths",
                                     "estimate"}));
}

TEST(Parameters, price_paths_against_occlusion_where_there_is_a_sky_and_against_nothing) {
    const auto settings_of = [](std::initializer_list<Effect> effects) {
        const ParameterDesign design = design_parameters(plan_with(effects), {});
        const auto indirect = std::ranges::find(design.parameters, "indirect", &Parameter::name);
        std::map<std::string, Configuration> settings;
        for (const ParameterSetting& setting : indirect->settings)
            settings[setting.name] = design.configurations[setting.configuration];
        return settings;
    };
    auto outside = settings_of({Effect::voxels, Effect::sky, Effect::indirect});
    EXPECT_EQ(outside.size(), 3u);
    EXPECT_EQ(outside["paths"], Configuration{});
    EXPECT_TRUE(is_chosen("indirect", "none", outside["ao"].settings));
    EXPECT_TRUE(outside["ao"].request.effects.switches.empty());
    EXPECT_EQ(outside["off"].request.effects.switches.at(Effect::ao), Switch::off);
    EXPECT_FALSE(settings_of({Effect::voxels, Effect::emission, Effect::indirect}).contains("ao"));
}

TEST(Parameters, price_microfacets_against_their_stand_in_where_the_plan_shows_them) {
    RenderPlan plan = plan_with({Effect::spheres, Effect::indirect});
    EXPECT_FALSE(parameters_of(design_parameters(plan, {})).contains("rough"));
    plan.shows_rough = true;
    const ParameterDesign design = design_parameters(plan, {});
    const auto rough = std::ranges::find(design.parameters, "rough", &Parameter::name);
    ASSERT_NE(rough, design.parameters.end());
    ASSERT_EQ(rough->settings.size(), 2u);
    EXPECT_EQ(design.configurations[rough->settings[0].configuration], Configuration{});
    EXPECT_TRUE(
        is_chosen("caustics", "photons", design.configurations[rough->settings[1].configuration].settings));
}

TEST(Parameters, change_one_setting_and_share_the_default) {
    RenderPlan plan = plan_with({Effect::voxels, Effect::ao});
    plan.world.traversal = Traversal::wide;
    const ParameterDesign design = design_parameters(plan, {});
    for (const Parameter& parameter : design.parameters) {
        if (parameter.name == "samples") continue;
        std::set<std::size_t> configurations;
        for (const ParameterSetting& setting : parameter.settings)
            EXPECT_TRUE(configurations.insert(setting.configuration).second)
                << parameter.name << " " << setting.name;
        EXPECT_TRUE(configurations.contains(0) || parameter.name == "ao_cell") << parameter.name;
    }
    EXPECT_EQ(design.configurations.size(),
              1u + 2u + 5u + 1u + 4u + 3u);  // base, sequences, worlds, hash, cells, rays
}

// Naming a technique of occlusion asks for it in place of paths.
TEST(Reference, names_a_way_of_occlusion_only_where_the_plan_has_occlusion) {
    const RenderPlan by_paths = plan_with({Effect::voxels, Effect::sky, Effect::indirect});
    EXPECT_EQ(reference_settings({}, by_paths), RenderSettings{});
    const RenderPlan by_occlusion = plan_with({Effect::voxels, Effect::sky, Effect::ao});
    EXPECT_EQ(reference_settings({}, by_occlusion).ao.method, AoMethod::brute);
}

Level level_of(std::uint32_t samples, double time_s, double error) {
    Level level{.samples = samples, .times_s = {time_s, 1.1 * time_s, 0.9 * time_s}};
    level.error = {.total = error, .noise = error, .squares = {error * error, error * error, error * error}};
    level.claimed.estimate = error;
    level.claimed.high = 2.0 * error;
    level.picture = Image{.width = 4, .height = 3};
    return level;
}

// Configuration 0 has noise alone; each other configuration takes twice the time for the same.
PriceList small_list() {
    PriceList list{.scene = "a.toml", .repeats = 3, .asked = 16, .top = 16};
    const RenderPlan plan = plan_with({Effect::voxels, Effect::ao});
    list.design = design_parameters(plan, {});
    for (std::size_t i = 0; i < list.design.configurations.size(); ++i) {
        MeasuredConfiguration configuration{.configuration = list.design.configurations[i], .plan = plan};
        const double factor = i == 0 ? 0.01 : 0.02;
        for (const std::uint32_t samples : {1u, 4u, 16u})
            configuration.levels.push_back(level_of(samples, factor * samples, 0.4 / std::sqrt(samples)));
        list.configurations.push_back(std::move(configuration));
    }
    list.effects = {{.effect = Effect::ao, .on = true, .ms_per_sample = 3.0, .error = 0.2}};
    list.equal_time.pictures.resize(1);
    list.equal_error.pictures.resize(1);
    return list;
}

TEST(PriceList, front_is_way_0_whose_slope_is_a_half) {
    const PriceList list = small_list();
    std::vector<std::string> front;
    for (const PricedRun& run : front_of(list, list_runs(list)))
        front.push_back(run.id);
    EXPECT_EQ(front, (std::vector<std::string>{"samples-1", "samples-4", "samples-16"}));
    EXPECT_NEAR(slope_of(list.configurations.front())->value, -0.5, 1e-9);
    EXPECT_NEAR(slope_of_samples(list.configurations.front())->value, -0.5, 1e-9);
}

TEST(PriceList, run_that_gets_cheap_joins_the_front) {
    PriceList list = small_list();
    list.configurations[1].levels.back().times_s = {0.005, 0.005, 0.005};
    const std::vector<PricedRun> front = front_of(list, list_runs(list));
    ASSERT_EQ(front.size(), 1u);
    EXPECT_EQ(front.front().configuration, 1u);
}

TEST(PriceList, way_without_a_level_has_no_run_and_says_why) {
    PriceList list = small_list();
    const std::size_t before = list_runs(list).size();
    list.configurations.back().levels.clear();
    list.configurations.back().refusal = "too large";
    EXPECT_EQ(list_runs(list).size(), before - 1);
    int left_out = 0;
    const nlohmann::ordered_json json = to_json(list);
    for (const auto& parameter : json["knobs"])
        for (const auto& setting : parameter["left_out"])
            left_out += setting["why"] == "too large" ? 1 : 0;
    EXPECT_EQ(left_out, 1);
}

TEST(PriceList, json_has_the_keys_that_pages_read) {
    const nlohmann::ordered_json json = to_json(small_list());
    for (const char* key : {"version", "command", "scene", "scene_hash", "seed", "size", "machine", "device",
                            "repeats", "wall_s", "reference", "runs", "knobs", "front", "effects",
                            "equal_time", "equal_error", "fixed", "difference_scale"})
        EXPECT_TRUE(json.contains(key)) << key;
    std::set<std::string> ids;
    for (const auto& run : json["runs"]) {
        EXPECT_TRUE(ids.insert(run["id"]).second) << run["id"];
        EXPECT_LE(run["time_s"]["low"], run["time_s"]["median"]);
        EXPECT_LE(run["time_s"]["median"], run["time_s"]["high"]);
        for (const char* key : {"total", "noise", "bias", "bias_low", "bias_high"})
            EXPECT_TRUE(run["error"].contains(key));
    }
    for (const auto& parameter : json["knobs"])
        for (const auto& id : parameter["runs"])
            EXPECT_TRUE(ids.contains(id)) << id;
    for (const auto& id : json["front"])
        EXPECT_TRUE(ids.contains(id)) << id;
    EXPECT_EQ(json["effects"].size(), kEffectCount);
    EXPECT_TRUE(json["effects"][0]["ms_per_sample"].is_null());  // voxels: not priced here
}

TEST(PriceList, csv_has_as_many_fields_as_names_in_each_line) {
    std::istringstream lines(to_csv(small_list()));
    std::string line;
    std::getline(lines, line);
    const auto commas = std::ranges::count(line, ',');
    std::size_t rows = 0;
    while (std::getline(lines, line)) {
        EXPECT_EQ(std::ranges::count(line, ','), commas) << line;
        ++rows;
    }
    EXPECT_EQ(rows,
              3 * (1u + 3u + 6u + 2u + 5u + 4u));  // levels of: samples, then the settings of each parameter
}

TEST(SamplePlan, halves_what_was_asked_until_it_fits) {
    std::vector<MeasuredConfiguration> configurations(3);
    for (MeasuredConfiguration& configuration : configurations)
        configuration.per_sample_s = 0.1;
    RenderSession* const any = reinterpret_cast<RenderSession*>(&configurations);  // only compared with null
    for (MeasuredConfiguration& configuration : configurations)
        configuration.session = any;
    const SamplePlan rich = plan_samples(configurations, 64, 3, 1e6);
    EXPECT_EQ(rich.top, 64u);
    EXPECT_EQ(rich.of_configuration[1], (std::vector<std::uint32_t>{4, 16, 64}));
    EXPECT_EQ(rich.of_configuration[0], (std::vector<std::uint32_t>{1, 2, 4, 8, 16, 32, 64}));
    const SamplePlan poor = plan_samples(configurations, 64, 3, 20.0);
    EXPECT_LT(poor.top, 64u);
    EXPECT_LE(poor.cost_s, 20.0);
    EXPECT_EQ(plan_samples(configurations, 64, 3, 0.0).top, 1u);
}

TEST(SamplePlan, slow_way_takes_fewer_samples_and_a_refused_one_none) {
    std::vector<MeasuredConfiguration> configurations(3);
    configurations[0].per_sample_s = 0.01;
    configurations[1].per_sample_s = 10.0;
    RenderSession* const any = reinterpret_cast<RenderSession*>(&configurations);
    configurations[0].session = configurations[1].session = any;
    const SamplePlan plan = plan_samples(configurations, 64, 3, 400.0);
    EXPECT_EQ(plan.top, 64u);
    EXPECT_EQ(plan.of_configuration[1], (std::vector<std::uint32_t>{1}));
    EXPECT_TRUE(plan.of_configuration[2].empty());
}

}  // namespace
}  // namespace voxilux
