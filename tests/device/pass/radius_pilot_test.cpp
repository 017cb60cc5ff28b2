// The first radius of photons, found on the test device.

#include <gtest/gtest.h>

#include "renderer/renderer.h"
#include "support/device_fixture.h"
#include "support/light_scenes.h"

namespace voxilux::test {
namespace {

// A few hundred photons for so many balls: no disc, however wide, holds as many photons as the pilot wants.
TEST(RadiusPilot, stops_where_discs_cover_the_surfaces) {
    constexpr double kBall = 0.5;
    Scene scene = dark_scene(32, 1024, 0.0);
    scene.settings.photons.radius.reset();  // a pilot finds it
    const auto lamp = add_emitter(scene, 4.0f);
    const auto grey = add_diffuse(scene, 0.5f);
    for (int i = 0; i < 1000; ++i)
        scene.spheres.push_back(
            {glm::dvec3(i % 10, i / 10 % 10, i / 100) * 3.0, kBall, i % 7 == 0 ? lamp : grey});
    Renderer renderer(test_device(), {});
    renderer.prepare(scene, {});
    ASSERT_TRUE(renderer.plan().photons.runs());
    EXPECT_GT(renderer.plan().photons.radius, 0.25 * kBall);
    EXPECT_LT(renderer.plan().photons.radius, 16.0 * kBall);
}

}  // namespace
}  // namespace voxilux::test
