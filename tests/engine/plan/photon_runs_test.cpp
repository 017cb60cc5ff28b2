// Photons of an iteration in several runs: the film of one run, to the bit, whatever their size.

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <numeric>

#include "engine/plan/plan_scenes.h"
#include "frame/frame.h"
#include "renderer/renderer.h"
#include "shared/counters.h"
#include "support/device_fixture.h"
#include "support/light_scenes.h"

namespace voxilux::test {
namespace {

constexpr std::uint32_t kPhotons = 60;
constexpr std::uint32_t kIterations = 2;

FilmSums film_in_runs(const Scene& scene, std::uint32_t at_once) {
    Renderer renderer(test_device(), {.poison_transients = true});
    renderer.prepare(scene, {});
    RenderPlan plan = renderer.plan();
    EXPECT_EQ(plan.photons.count(), kPhotons);
    plan.photons.at_once = at_once;
    FilmSteps steps(plan, renderer.executor(), true);
    steps.start_frame(frame_params(plan, scene, renderer.prepared().march_world));
    std::uint64_t faults = 0;
    while (steps.position().samples < kIterations) {
        const StepResult step = steps.step_tile();
        faults = std::accumulate(step.counters.begin(), step.counters.begin() + gpu::kFaultCount, faults);
    }
    EXPECT_EQ(faults, 0u);
    return steps.read();
}

class PhotonRuns : public testing::TestWithParam<std::string> {};

TEST_P(PhotonRuns, of_any_size_give_the_same_film) {
    const Scene scene =
        repository_scene("cornell", {"render.size=[24, 18]", fmt::format("photons.count={}", kPhotons),
                                     "photons.radius=3", fmt::format("technique.caustics=\"{}\"", GetParam()),
                                     fmt::format("technique.indirect=\"{}\"", GetParam())});
    const FilmSums whole = film_in_runs(scene, kPhotons);
    for (const std::uint32_t at_once : {1u, 7u})
        EXPECT_EQ(film_in_runs(scene, at_once), whole) << at_once;
    Scene another = scene;
    another.settings.photons.radius = 3.5;  // changes only the light of photons
    EXPECT_NE(film_in_runs(another, kPhotons), whole);
}

TEST(PhotonRunsOfTwoLightsNightly, across_the_border_of_lamp_and_sun_give_the_same_film) {
    Scene scene = dark_scene(24, kPhotons, 3.0);
    add_box(scene, {-8, -8, -1}, {8, 8, 0}, add_diffuse(scene, 0.7f));
    add_box(scene, {-1, 3, 6}, {1, 5, 7}, add_emitter(scene, 50.0f));
    scene.spheres.push_back({{0.0, -2.0, 3.0}, 1.5, add_glass(scene, 1.5f)});
    scene.sun.on = true;
    scene.camera = camera_towards({9, -13, 8}, {0, 0, 1}, 50.0);
    const FilmSums whole = film_in_runs(scene, kPhotons);
    for (const std::uint32_t at_once : {7u, 13u})  // not all of them end at the border
        EXPECT_EQ(film_in_runs(scene, at_once), whole) << at_once;
    Renderer renderer(test_device(), {});
    renderer.prepare(scene, {});
    EXPECT_GT(renderer.plan().photons.sun_photons, 0u);
    EXPECT_GT(renderer.plan().photons.emitter_photons, 0u);
}

INSTANTIATE_TEST_SUITE_P(Techniques, PhotonRuns, testing::Values("photons", "splatting", "pixel_radii"),
                         [](const testing::TestParamInfo<std::string>& one) { return one.param; });

}  // namespace
}  // namespace voxilux::test
