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
        EXPECT_EQ(run.shaders, (Names{"world_grow", "primary_beam", "primary_march", "path_start",
                                      "path_trace", "film_add", "aov_position"}));
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

// What the session ran and needed: passes with their counts, buffers with their bytes. After so many samples
// the device has freed what only the upload needed.
TEST_P(LeanRenderOf, report_names_the_passes_and_buffers_of_the_plan) {
    const Scene scene = test::repository_scene(GetParam(), {"render.size=[32, 24]", "render.spp=24"});
    const RenderOutcome outcome = render_scene(scene, {.plan = test::exr_request()});
    const Footprint needs = footprint(test::plan_of(scene));
    std::map<std::string, std::uint64_t> ran, held, planned;
    for (const PassTime& pass : outcome.statistics.passes)
        ran[pass.label] = pass.count;
    EXPECT_EQ(ran, test::planned_counts(needs));
    for (const MemoryRow& row : outcome.statistics.memory)
        if (row.buffer != "executor.staging") held[row.buffer] = row.bytes;
    for (const PlannedBuffer& buffer : needs.buffers)
        planned[buffer.buffer] = buffer.bytes;
    EXPECT_EQ(held, planned);
}

INSTANTIATE_TEST_SUITE_P(scenes, LeanRenderOf, testing::ValuesIn(test::scene_names()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace voxilux
