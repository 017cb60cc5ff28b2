#include <gtest/gtest.h>

#include <algorithm>

#include "engine/plan/plan_scenes.h"
#include "passes/sky/sky.h"

namespace voxilux {
namespace {

using Sizes = std::map<std::string, std::pair<std::uint64_t, bool>>;

// Name, bytes and persistence of every buffer.
Sizes recorded_sizes(const test::RecordedRender& render) {
    Sizes sizes;
    for (const auto& [name, proxy] : render.buffers)
        sizes[name] = {proxy.size_bytes, proxy.persistent};
    return sizes;
}

Sizes planned_sizes(const Footprint& needs) {
    Sizes sizes;
    for (const PlannedBuffer& planned : needs.buffers)
        EXPECT_TRUE(sizes.emplace(planned.buffer, std::pair(planned.bytes, planned.persistent)).second)
            << planned.buffer << " is planned twice";
    return sizes;
}

// The first radius is set, since a pilot is not part of a frame: footprint() counts what the pilot holds.
void expect_as_planned(Scene scene, const PlanRequest& request) {
    scene.settings.photons.radius = 1.0;
    const PreparedScene prepared = prepare_scene(scene, request, DeviceLimits{});
    const test::RecordedRender render = test::record_render(scene, prepared);
    const Footprint needs = footprint(prepared.plan);
    EXPECT_EQ(recorded_sizes(render), planned_sizes(needs));
    EXPECT_EQ(render.dispatches, test::planned_counts(needs));
}

class RecordedPlan : public testing::TestWithParam<std::string> {};

TEST_P(RecordedPlan, render_declares_and_dispatches_exactly_the_plan) {
    const Scene scene = test::repository_scene(GetParam(), {"render.spp=3"});
    expect_as_planned(scene, test::exr_request());
}

TEST_P(RecordedPlan, colour_only_render_declares_and_dispatches_exactly_the_plan) {
    expect_as_planned(test::repository_scene(GetParam(), {"render.spp=2"}), PlanRequest{});
}

// Two film tiles, the second one shorter.
TEST_P(RecordedPlan, banded_render_declares_and_dispatches_exactly_the_plan) {
    const Scene scene = test::repository_scene(GetParam(), {"render.spp=2", "render.size=[1280, 1000]"});
    ASSERT_EQ(test::plan_of(scene).film_tile_count, 2u);
    expect_as_planned(scene, test::exr_request());
}

// A picture so high that a film tile takes several tiles.
TEST_P(RecordedPlan, high_render_declares_and_dispatches_exactly_the_plan) {
    Scene scene = test::repository_scene(GetParam(), {"render.spp=2"});
    scene.settings.size = {4, 131072};
    const RenderPlan plan = test::plan_of(scene);
    ASSERT_LT(plan.tile_rows, plan.film_tile_rows);
    expect_as_planned(scene, test::exr_request());
}

// A window of an image is planned as a picture of its own size.
TEST_P(RecordedPlan, cropped_render_declares_and_dispatches_exactly_the_plan) {
    const Scene scene = test::repository_scene(GetParam(), {"render.spp=2", "render.size=[640, 360]"});
    PlanRequest request = test::exr_request();
    request.crop = PixelWindow{{100, 200}, {140, 230}};
    expect_as_planned(scene, request);
    const Scene small = test::repository_scene(GetParam(), {"render.spp=2", "render.size=[40, 30]"});
    EXPECT_EQ(footprint(test::plan_of(scene, request)), footprint(test::plan_of(small)));
    EXPECT_EQ(test::plan_of(scene, request).rays, test::plan_of(small).rays);
}

TEST_P(RecordedPlan, every_switch_off_is_still_exactly_the_plan) {
    const Scene scene = test::repository_scene(GetParam(), {"render.spp=1"});
    for (std::size_t i = 0; i < kEffectCount; ++i) {
        SCOPED_TRACE(name_of(static_cast<Effect>(i)));
        expect_as_planned(scene, test::with_switch(test::exr_request(), static_cast<Effect>(i), Switch::off));
        expect_as_planned(scene, test::with_switch(PlanRequest{}, static_cast<Effect>(i), Switch::on));
    }
}

// The names that belong to one effect: first words of labels, buffers and shaders, and its film planes.
struct Traces {
    Effect effect;
    std::vector<std::string> prefixes;
};

const std::vector<Traces>& traces_of_effects() {
    static const std::vector<Traces> traces = {
        {Effect::voxels, {"primary.", "primary_", "world."}},
        {Effect::spheres, {"sphere.", "sphere_"}},
        {Effect::specular, {"specular.", "specular_"}},
        {Effect::ao, {"ao.", "ao_", "film.ao."}},
        {Effect::sun, {"sun.", "sun_", "film.sun."}},
        {Effect::aerial, {"aerial.", "aerial_"}},
        {Effect::direct, {"direct.", "direct_"}},
        {Effect::aov, {"aov.", "aov_", "film.albedo.", "film.normal.", "film.position.", "film.depth."}},
    };
    return traces;
}

// Everything in the recordings whose name starts with one of these words.
std::vector<std::string> found_traces(const test::RecordedRender& render,
                                      const std::vector<std::string>& prefixes) {
    std::vector<std::string> found;
    const auto look_at = [&](const std::string& name) {
        for (const std::string& prefix : prefixes)
            if (name.starts_with(prefix)) found.push_back(name);
    };
    for (const auto& [name, proxy] : render.buffers)
        look_at(name);
    for (const auto& [label, count] : render.dispatches)
        look_at(label);
    for (const std::string& shader : render.shaders)
        look_at(shader);
    return found;
}

// Labels, buffers and shaders exist if and only if the effect is on: the second half is the negative control
// of the first.
void expect_traces_follow_effects(const Scene& scene, const PlanRequest& request) {
    const PreparedScene prepared = prepare_scene(scene, request, DeviceLimits{});
    const test::RecordedRender render = test::record_render(scene, prepared);
    for (const Traces& traces : traces_of_effects()) {
        const std::vector<std::string> found = found_traces(render, traces.prefixes);
        if (prepared.plan.has(traces.effect)) {
            // Rays towards an atmosphere also find its occlusion; of that only the visibility is left.
            const bool is_shared = traces.effect == Effect::ao && traces_sky(prepared.plan);
            EXPECT_GE(found.size(), is_shared ? 1u : 3u)
                << name_of(traces.effect) << " is on but leaves too few traces";
        } else {
            EXPECT_EQ(found, std::vector<std::string>{}) << name_of(traces.effect) << " is off";
        }
    }
    EXPECT_EQ(!found_traces(render, {"sky.", "sky_"}).empty(), prepared.plan.has_sky_plane());
    const RenderPlan& plan = prepared.plan;
    const auto is_found = [&](bool (RenderPlan::*by)(Effect) const) {
        return (plan.*by)(Effect::caustics) || (plan.*by)(Effect::indirect);
    };
    EXPECT_EQ(!found_traces(render, {"photon.", "photon_"}).empty(), is_found(&RenderPlan::is_by_photons));
    EXPECT_EQ(!found_traces(render, {"path.", "path_"}).empty(), is_found(&RenderPlan::is_by_paths));
    const bool needs_emitters = plan.has(Effect::direct) || plan.photons.emitter_photons != 0 ||
                                (plan.paths.runs() && plan.has(Effect::emission));
    EXPECT_EQ(!found_traces(render, {"light."}).empty(), needs_emitters);
}

TEST_P(RecordedPlan, absent_effect_leaves_no_command_buffer_or_shader) {
    const Scene scene = test::repository_scene(GetParam(), {"render.spp=1"});
    expect_traces_follow_effects(scene, test::exr_request());
    expect_traces_follow_effects(scene, PlanRequest{});
    for (std::size_t i = 0; i < kEffectCount; ++i) {
        SCOPED_TRACE(name_of(static_cast<Effect>(i)));
        expect_traces_follow_effects(
            scene, test::with_switch(test::exr_request(), static_cast<Effect>(i), Switch::off));
    }
}

INSTANTIATE_TEST_SUITE_P(scenes, RecordedPlan, testing::ValuesIn(test::scene_names()),
                         [](const auto& test) { return test.param; });

TEST(RecordedPlanOf, empty_scene_records_shading_alone) {
    const Scene scene = test::repository_scene("empty", {"render.spp=1"});
    const auto render = test::record_render(scene, prepare_scene(scene, PlanRequest{}, DeviceLimits{}));
    EXPECT_EQ(render.shaders, (std::set<std::string>{"film_add"}));
    EXPECT_FALSE(render.buffers.contains("materials"));
}

TEST(RecordedPlanOf, unneeded_effect_that_is_forced_on_is_recorded) {
    const Scene scene = test::repository_scene("black_sky", {"render.spp=1"});
    const auto prepared =
        prepare_scene(scene, test::with_switch(PlanRequest{}, Effect::ao, Switch::on), DeviceLimits{});
    EXPECT_TRUE(test::record_render(scene, prepared).shaders.contains("ao_trace"));
}

// What a recorder adds to the real one is in the footprint, with no other change.
TEST(RecordedPlanOf, pass_that_the_recording_gains_is_planned_with_its_count_and_bytes) {
    const RenderPlan plan = test::plan_of(test::repository_scene("night", {"render.spp=5"}));
    const auto record = [](const RenderPlan& of, const DispatchTile& tile, gpu::FrameParams params,
                           const SampleNumber& number, Recording& recording) {
        record_frame(of, tile, params, number, recording);
        const std::string words = declare<float>(recording, "extra.words", 7);
        recording.dispatch({.label = "extra.step", .shader = "x", .bindings = {{"Words", words}}});
        if (number.sample == 0) recording.dispatch({.label = "extra.first", .shader = "x"});
        if (number.sample == 1) recording.dispatch({.label = "extra.later", .shader = "x"});
    };
    const Footprint with = footprint(plan, record);
    const auto counts = test::planned_counts(with);
    EXPECT_EQ(counts.at("extra.step"), 5u);
    EXPECT_EQ(counts.at("extra.first"), 1u);
    EXPECT_EQ(counts.at("extra.later"), 4u) << "all samples after the first record what the second does";
    const auto extra = std::ranges::find(with.buffers, "extra.words", &PlannedBuffer::buffer);
    ASSERT_NE(extra, with.buffers.end());
    EXPECT_EQ(extra->bytes, 28u);
    const Footprint without = footprint(plan);
    EXPECT_EQ(with.total_bytes(), without.total_bytes() + 28);
    EXPECT_EQ(with.passes.size(), without.passes.size() + 3);
}

// A frame that gives up cells, as later ones of a range may; a single frame never does.
TEST(RecordedPlanOf, giving_up_cells_is_planned_once_a_frame_of_a_range) {
    const Scene scene = test::repository_scene("mixed", {"ao.method=hash", "render.spp=3"});
    PlanRequest request = test::exr_request();
    EXPECT_FALSE(test::planned_counts(footprint(test::plan_of(scene, request))).contains("ao.age"));
    request.frames = 2;
    const auto counts = test::planned_counts(footprint(test::plan_of(scene, request)));
    EXPECT_EQ(counts.at("ao.age"), 1u);
    EXPECT_EQ(counts.at("ao.sample"), 3u);
}

// The radius of photons is found by an iteration whose buffers stay on the device.
TEST(RecordedPlanOf, pilot_of_photons_is_held_but_not_run_in_the_frame) {
    const auto planned = [](const std::vector<std::string>& overrides) {
        return footprint(test::plan_of(test::repository_scene("cornell", overrides)));
    };
    const Footprint known = planned({"photons.radius=1"}), piloted = planned({});
    EXPECT_EQ(piloted.passes, known.passes);
    const auto holds_radii = [](const Footprint& needs) {
        return std::ranges::find(needs.buffers, "photon.radii", &PlannedBuffer::buffer) !=
               needs.buffers.end();
    };
    EXPECT_TRUE(holds_radii(piloted));
    EXPECT_FALSE(holds_radii(known));
}

}  // namespace
}  // namespace voxilux
