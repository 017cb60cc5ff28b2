// How passes read the world: by texels, or by addresses on GPUs and for worlds that do not fit in texels.

#include <gtest/gtest.h>

#include "engine/plan/plan_scenes.h"
#include "frame/frame.h"
#include "renderer/renderer.h"
#include "support/device_fixture.h"

namespace voxilux::test {
namespace {

FilmSums film_of(const Scene& scene, bool by_texels, std::uint32_t samples) {
    Renderer renderer(test_device(), {.poison_transients = true});
    renderer.prepare(scene, {});
    RenderPlan plan = renderer.plan();
    EXPECT_TRUE(plan.has_world_texels) << "or this tests nothing";
    plan.has_world_texels = by_texels;
    FilmSteps steps(plan, renderer.executor(), true);
    steps.start_frame(frame_params(plan, scene, renderer.prepared().march_world));
    while (steps.position().samples < samples)
        (void)steps.step_tile();
    return steps.read();
}

TEST(WorldAccessNightly, film_is_the_same_by_texels_and_by_addresses) {
    for (const char* name : {"mixed", "glass_block"}) {
        const Scene scene = repository_scene(name, {"render.size=[16, 12]"});
        const FilmSums by_texels = film_of(scene, true, 2);
        EXPECT_EQ(film_of(scene, false, 2), by_texels) << name;
        EXPECT_NE(film_of(scene, false, 3), by_texels) << name << ", the negative control";
    }
}

}  // namespace
}  // namespace voxilux::test
