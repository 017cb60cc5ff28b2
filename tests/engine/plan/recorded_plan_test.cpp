#include <gtest/gtest.h>

#include "engine/plan/plan_scenes.h"
#include "passes/plane.h"

namespace voxilux {
namespace {

using Sizes = std::map<std::string, std::pair<std::uint64_t, bool>>;

// Name, bytes and persistence of every buffer that is not a constant: a constant is one element that stands
// for an effect that is off.
Sizes recorded_sizes(const test::RecordedRender& render) {
    Sizes sizes;
    for (const auto& [name, proxy] : render.buffers) {
        if (name.starts_with("constant.")) continue;
        sizes[name] = {proxy.size_bytes, proxy.persistent};
    }
    return sizes;
}

Sizes planned_sizes(const RenderPlan& plan) {
    Sizes sizes;
    for (const PlannedBuffer& planned : plan.buffers)
        EXPECT_TRUE(sizes.emplace(planned.buffer, std::pair(planned.bytes, planned.persistent)).second)
            << planned.buffer << " is planned twice";
    return sizes;
}

std::map<std::string, std::uint64_t> planned_counts(const RenderPlan& plan) {
    std::map<std::string, std::uint64_t> counts;
    for (const PlannedPass& pass : plan.passes)
        EXPECT_TRUE(counts.emplace(pass.label, pass.count).second) << pass.label << " is planned twice";
    return counts;
}

void expect_as_planned(const Scene& scene, const PlanRequest& request) {
    const PreparedScene prepared = prepare_scene(scene, request, DeviceLimits{});
    const test::RecordedRender render = test::record_render(scene, prepared);
    EXPECT_EQ(recorded_sizes(render), planned_sizes(prepared.plan));
    EXPECT_EQ(render.dispatches, planned_counts(prepared.plan));
}

class RecordedPlan : public testing::TestWithParam<std::string> {};

TEST_P(RecordedPlan, render_declares_and_dispatches_exactly_the_plan) {
    const Scene scene = test::repository_scene(GetParam(), {"render.spp=3"});
    expect_as_planned(scene, test::exr_request());
}

TEST_P(RecordedPlan, colour_only_render_declares_and_dispatches_exactly_the_plan) {
    expect_as_planned(test::repository_scene(GetParam(), {"render.spp=2"}), PlanRequest{});
}

// Two film bands, the second one shorter.
TEST_P(RecordedPlan, banded_render_declares_and_dispatches_exactly_the_plan) {
    const Scene scene = test::repository_scene(GetParam(), {"render.spp=2", "render.size=[1280, 1000]"});
    ASSERT_EQ(test::plan_of(scene).band_count, 2u);
    expect_as_planned(scene, test::exr_request());
}

// A picture so high that a band takes several slices.
TEST_P(RecordedPlan, high_render_declares_and_dispatches_exactly_the_plan) {
    Scene scene = test::repository_scene(GetParam(), {"render.spp=2"});
    scene.settings.size = {4, 131072};
    const RenderPlan plan = test::plan_of(scene);
    ASSERT_LT(plan.slice_rows, plan.band_rows);
    expect_as_planned(scene, test::exr_request());
}

// A window of an image is planned as a picture of its own size.
TEST_P(RecordedPlan, cropped_render_declares_and_dispatches_exactly_the_plan) {
    const Scene scene = test::repository_scene(GetParam(), {"render.spp=2", "render.size=[640, 360]"});
    PlanRequest request = test::exr_request();
    request.crop = PixelWindow{{100, 200}, {140, 230}};
    expect_as_planned(scene, request);
    const Scene small = test::repository_scene(GetParam(), {"render.spp=2", "render.size=[40, 30]"});
    EXPECT_EQ(test::plan_of(scene, request).buffers, test::plan_of(small).buffers);
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

// The names that belong to an effect alone: first words of labels, buffers and shaders, and its film planes.
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
        {Effect::direct, {"direct.", "direct_"}},
        {Effect::aov, {"aov.", "aov_", "film.albedo.", "film.normal.", "film.position.", "film.depth."}},
    };
    return traces;
}

// Everything in the recordings whose name starts so.
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

// Labels, buffers and shaders exist if and only if the effect is on: the second half is the twin of the
// first.
void expect_traces_follow_effects(const Scene& scene, const PlanRequest& request) {
    const PreparedScene prepared = prepare_scene(scene, request, DeviceLimits{});
    const test::RecordedRender render = test::record_render(scene, prepared);
    for (const Traces& traces : traces_of_effects()) {
        const std::vector<std::string> found = found_traces(render, traces.prefixes);
        if (prepared.plan.has(traces.effect)) {
            EXPECT_GE(found.size(), 3u) << name_of(traces.effect) << " is on but leaves too few traces";
        } else {
            EXPECT_EQ(found, std::vector<std::string>{}) << name_of(traces.effect) << " is off";
        }
    }
    const bool has_photons = prepared.plan.has(Effect::caustics) || prepared.plan.has(Effect::indirect);
    EXPECT_EQ(!found_traces(render, {"photon.", "photon_"}).empty(), has_photons);
    const bool needs_lamps = prepared.plan.has(Effect::direct) || prepared.plan.photons.lamp_photons != 0;
    EXPECT_EQ(!found_traces(render, {"light."}).empty(), needs_lamps);
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
    EXPECT_EQ(render.shaders, (std::set<std::string>{"shade_resolve", "film_add"}));
    EXPECT_FALSE(render.buffers.contains("materials"));
}

TEST(RecordedPlanOf, unneeded_effect_that_is_forced_on_is_recorded) {
    const Scene scene = test::repository_scene("black_sky", {"render.spp=1"});
    const auto prepared =
        prepare_scene(scene, test::with_switch(PlanRequest{}, Effect::ao, Switch::on), DeviceLimits{});
    EXPECT_TRUE(test::record_render(scene, prepared).shaders.contains("ao_trace"));
}

TEST(RecordedPlanOf, buffer_of_an_absent_effect_is_our_mistake) {
    const RenderPlan plan = test::plan_of(test::repository_scene("night"));
    Recording recording;
    EXPECT_THROW((void)use_buffer(plan, "sun.lit", recording), InternalError);
    EXPECT_EQ(use_buffer(plan, "ao.open", recording), "ao.open");
}

}  // namespace
}  // namespace voxilux
