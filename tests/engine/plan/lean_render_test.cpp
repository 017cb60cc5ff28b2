#include <gtest/gtest.h>

#include "engine/plan/plan_scenes.h"
#include "support/device_fixture.h"

namespace voxilux {
namespace {

// A render on the device with nothing else in its executor.
struct LeanRun {
    std::set<std::string> shaders;
    std::set<std::string> buffers;  // alive afterwards, staging memory left out
    std::uint64_t pipelines = 0;
};

LeanRun run_lean(const Scene& scene, const PlanRequest& request) {
    const PreparedScene prepared = prepare_scene(scene, request, test_device().limits());
    const test::RecordedRender render = test::record_render(scene, prepared);
    Executor executor(test_device(), pass_shaders(), {.poison_transients = true});
    for (const Recording& recording : render.recordings)
        executor.run(recording);
    LeanRun run{.shaders = render.shaders, .pipelines = executor.pipelines_created()};
    for (const MemoryRow& row : executor.memory()) {
        if (row.buffer != "executor.staging") run.buffers.insert(row.buffer);
    }
    return run;
}

LeanRun run_lean(const std::string& name, const PlanRequest& request = test::exr_request()) {
    return run_lean(test::repository_scene(name, {"render.size=[32, 24]", "render.spp=2"}), request);
}

bool any_starts_with(const std::set<std::string>& names, std::string_view prefix) {
    const auto found = names.lower_bound(std::string(prefix));
    return found != names.end() && found->starts_with(prefix);
}

using Names = std::set<std::string>;

TEST(LeanRender, sun_below_the_horizon_leaves_no_command_buffer_or_pipeline) {
    for (const char* scene : {"night", "overcast"}) {
        const LeanRun run = run_lean(scene);
        EXPECT_EQ(run.shaders, (Names{"primary_beam", "primary_march", "path_start", "path_trace", "film_add",
                                      "aov_position"}));
        EXPECT_EQ(run.pipelines, run.shaders.size()) << scene;
        EXPECT_FALSE(any_starts_with(run.buffers, "sun")) << scene;
        EXPECT_FALSE(any_starts_with(run.buffers, "film.sun")) << scene;
    }
}

// Negative control: the same scene with the sun up costs one more shader, pipeline, buffer and film plane.
TEST(LeanRender, sun_above_the_horizon_adds_its_own_and_no_more) {
    const LeanRun night = run_lean("night");
    const LeanRun day = run_lean(
        test::repository_scene("night", {"render.size=[32, 24]", "render.spp=2", "sun.elevation=10"}),
        test::exr_request());
    EXPECT_TRUE(day.shaders.contains("sun_trace"));
    EXPECT_EQ(day.pipelines, night.pipelines + 1);
    EXPECT_TRUE(day.buffers.contains("sun.lit"));
    EXPECT_TRUE(day.buffers.contains("film.sun.0"));
}

TEST(LeanRender, empty_scene_has_no_march_and_no_world) {
    const LeanRun run = run_lean("empty", PlanRequest{});
    EXPECT_EQ(run.shaders, (Names{"film_add"}));
    EXPECT_EQ(run.pipelines, 1u);
    EXPECT_FALSE(any_starts_with(run.buffers, "world"));
    EXPECT_FALSE(any_starts_with(run.buffers, "primary"));
    EXPECT_FALSE(any_starts_with(run.buffers, "sphere"));
    EXPECT_FALSE(run.buffers.contains("materials"));
}

TEST(LeanRender, colour_only_output_has_no_aov) {
    const LeanRun run = run_lean("night", PlanRequest{});
    EXPECT_FALSE(any_starts_with(run.shaders, "aov"));
    EXPECT_FALSE(any_starts_with(run.buffers, "aov"));
    EXPECT_FALSE(any_starts_with(run.buffers, "film.albedo"));
    EXPECT_FALSE(any_starts_with(run.buffers, "film.depth"));
    EXPECT_TRUE(any_starts_with(run_lean("night").buffers, "film.albedo")) << "negative control";
}

TEST(LeanRender, black_sky_has_no_ao) {
    const LeanRun run = run_lean("black_sky");
    EXPECT_FALSE(run.shaders.contains("ao_trace"));
    EXPECT_FALSE(any_starts_with(run.buffers, "ao."));
    EXPECT_FALSE(any_starts_with(run.buffers, "film.ao"));
}

TEST(LeanRender, spheres_alone_have_no_world) {
    const LeanRun run = run_lean("spheres");
    EXPECT_FALSE(run.shaders.contains("primary_march"));
    EXPECT_FALSE(any_starts_with(run.buffers, "world"));
    EXPECT_FALSE(any_starts_with(run.buffers, "primary"));
    EXPECT_TRUE(run.buffers.contains("sphere.records"));
}

// What a session ran and held, and what its plan predicts.
using NamedNumbers = std::map<std::string, std::uint64_t>;

NamedNumbers passes_of(const RenderOutcome& outcome) {
    NamedNumbers passes;
    for (const PassTime& pass : outcome.statistics.passes)
        passes[pass.label] = pass.count;
    return passes;
}

NamedNumbers buffers_of(const RenderOutcome& outcome) {
    NamedNumbers buffers;
    for (const MemoryRow& row : outcome.statistics.memory)
        if (row.buffer != "executor.staging") buffers[row.buffer] = row.bytes;
    return buffers;
}

NamedNumbers buffers_of(const Footprint& needs) {
    NamedNumbers buffers;
    for (const PlannedBuffer& buffer : needs.buffers)
        buffers[buffer.buffer] = buffer.bytes;
    return buffers;
}

class LeanRenderOf : public testing::TestWithParam<std::string> {};

// The device holds the buffers of the plan, and one pipeline per shader.
TEST_P(LeanRenderOf, device_holds_the_plan_and_nothing_else) {
    const Scene scene =
        test::repository_scene(GetParam(), {"render.size=[32, 24]", "render.spp=2", "photons.radius=1"});
    const LeanRun run = run_lean(scene, test::exr_request());
    Names planned;
    for (const PlannedBuffer& buffer : footprint(test::plan_of(scene)).buffers)
        planned.insert(buffer.buffer);
    EXPECT_EQ(run.buffers, planned);
    const std::size_t levels = run.shaders.contains("photon_scan") ? 2 : 0;  // it has three variants
    EXPECT_EQ(run.pipelines, run.shaders.size() + levels);
}

// What the session ran and needed: passes with their counts, buffers with their bytes. After this many
// samples the device has freed what only the upload needed.
TEST_P(LeanRenderOf, report_names_the_passes_and_buffers_of_the_plan) {
    const Scene scene = test::repository_scene(GetParam(), {"render.size=[32, 24]", "render.spp=24"});
    const RenderOutcome outcome = render_scene(scene, {.plan = test::exr_request()});
    const Footprint needs = footprint(test::plan_of(scene));
    EXPECT_EQ(passes_of(outcome), test::planned_counts(needs));
    EXPECT_EQ(buffers_of(outcome), buffers_of(needs));
}

// Passes that follow the last sample. How often those of samples run in a large image depends on the speed of
// the machine.
NamedNumbers final_passes(NamedNumbers passes) {
    std::erase_if(passes, [](const auto& pass) {
        return !pass.first.starts_with("denoise.") || pass.first == "denoise.guide";
    });
    return passes;
}

// Filtered in two strips for an image of this size.
TEST(LeanRenderNightly, denoiser_is_in_the_plan_as_in_the_report) {
    PlanRequest request = test::exr_request();
    request.wants_denoised = true;
    const Scene scene = test::repository_scene("mixed", {"render.size=[1200, 900]", "render.spp=2"});
    const RenderOutcome outcome = render_scene(scene, {.plan = request});
    const Footprint needs = footprint(test::plan_of(scene, request));
    EXPECT_EQ(final_passes(passes_of(outcome)), final_passes(test::planned_counts(needs)));
    EXPECT_EQ(passes_of(outcome).at("denoise.error"), 2u);
    EXPECT_EQ(buffers_of(outcome), buffers_of(needs));
}

TEST(LeanRender, nothing_of_the_denoiser_runs_where_it_cannot_filter) {
    PlanRequest request = test::exr_request();
    request.wants_denoised = true;
    for (const char* setting : {"render.spp=1", "ao.method=\"hash\""}) {
        const Scene scene =
            test::repository_scene("mixed", {"render.size=[32, 24]", "render.spp=2", setting});
        const RenderOutcome outcome = render_scene(scene, {.plan = request});
        for (const auto& [pass, count] : passes_of(outcome))
            EXPECT_FALSE(pass.starts_with("denoise.")) << setting << ' ' << pass;
        EXPECT_FALSE(outcome.denoised.value().is_filtered()) << setting;
        EXPECT_FALSE(outcome.denoised.value().reason.empty()) << setting;
    }
}

INSTANTIATE_TEST_SUITE_P(scenes, LeanRenderOf, testing::ValuesIn(test::scene_names()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace voxilux
