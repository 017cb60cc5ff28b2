#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "engine/plan/plan_scenes.h"

namespace voxilux {
namespace {

Image render(const Scene& scene, const PlanRequest& request) {
    const RenderOutcome outcome = render_scene(scene, {.plan = request, .device = {.validation = true}});
    EXPECT_EQ(outcome.statistics.validation, std::vector<std::string>{});
    for (const auto& [name, count] : outcome.statistics.faults)
        EXPECT_EQ(count, 0u) << name;
    return outcome.image;
}

Scene small_scene(const std::string& name) {
    return test::repository_scene(name, {"render.size=[48, 27]", "render.spp=2"});
}

// Colour values whose bits differ.
int differing_values(const Image& a, const Image& b) {
    int count = 0;
    for (const char* channel : {"R", "G", "B"}) {
        const std::vector<float>& x = a.channels.at(channel).pixels;
        const std::vector<float>& y = b.channels.at(channel).pixels;
        EXPECT_EQ(x.size(), y.size());
        for (std::size_t i = 0; i < x.size(); ++i)
            count += std::memcmp(&x[i], &y[i], sizeof(float)) != 0 ? 1 : 0;
    }
    return count;
}

TEST(ForcedEffect, occlusion_under_a_black_sky_changes_no_bit) {
    const Scene scene = small_scene("black_sky");
    const PlanRequest forced = test::with_switch(test::exr_request(), Effect::ao, Switch::on);
    ASSERT_TRUE(test::plan_of(scene, forced).has(Effect::ao));
    EXPECT_EQ(differing_values(render(scene, test::exr_request()), render(scene, forced)), 0);
}

// Of the light of the image. Too little for the plan to switch it on.
double share_of_air(const Scene& scene) {
    const Image with = render(scene, test::with_switch(PlanRequest{}, Effect::aerial, Switch::on));
    const Image without = render(scene, test::with_switch(PlanRequest{}, Effect::aerial, Switch::off));
    double change = 0.0, light = 0.0;
    for (const char* channel : {"R", "G", "B"}) {
        const std::vector<float>& x = with.channels.at(channel).pixels;
        const std::vector<float>& y = without.channels.at(channel).pixels;
        for (std::size_t i = 0; i < x.size(); ++i) {
            change += std::abs(double{x[i]} - double{y[i]});
            light += double{y[i]};
        }
    }
    return change / light;
}

TEST(ForcedEffectNightly, air_that_the_plan_leaves_out_changes_less_than_a_thousandth) {
    for (const char* name : {"noon", "dusk", "blue_hour"}) {
        const Scene scene = small_scene(name);
        ASSERT_FALSE(test::plan_of(scene, PlanRequest{}).has(Effect::aerial)) << name;
        EXPECT_LT(share_of_air(scene), 1e-3) << name;
        EXPECT_GT(share_of_air(scene), 0.0) << name;
    }
    EXPECT_GT(share_of_air(small_scene("far_hills")), 0.05);
}

TEST(ForcedEffect, extra_channels_change_no_bit_of_the_colour) {
    const Scene scene = small_scene("mixed");
    const PlanRequest forced = test::with_switch(PlanRequest{}, Effect::aov, Switch::on);
    ASSERT_TRUE(test::plan_of(scene, forced).has(Effect::aov));
    EXPECT_EQ(differing_values(render(scene, PlanRequest{}), render(scene, forced)), 0);
}

// Forcing an effect that a scene does not call for changes nothing in the plan if the effect is impossible.
// Otherwise the effect is one of those above, or sunlight between surfaces, for which occlusion of the sky
// stands in: forcing that one does change the picture, as the plan says.
TEST(ForcedEffect, unneeded_effect_is_impossible_or_tested_here) {
    for (const std::string& name : test::scene_names()) {
        const Scene scene = small_scene(name);
        const RenderPlan plan = test::plan_of(scene, PlanRequest{});
        for (std::size_t i = 0; i < kEffectCount; ++i) {
            const auto effect = static_cast<Effect>(i);
            if (plan.has(effect) || effect == Effect::ao || effect == Effect::aov ||
                effect == Effect::indirect || effect == Effect::aerial)
                continue;
            EXPECT_EQ(test::plan_of(scene, test::with_switch(PlanRequest{}, effect, Switch::on)), plan)
                << name << ": " << name_of(effect);
        }
    }
}

struct Needed {
    const char* scene;
    Effect effect;
};

void PrintTo(const Needed& needed, std::ostream* os) {
    *os << needed.scene << " without " << name_of(needed.effect);
}

class NeededEffect : public testing::TestWithParam<Needed> {};

// Negative control: an effect that runs changes the picture.
TEST_P(NeededEffect, switched_off_changes_the_picture) {
    const auto [name, effect] = GetParam();
    const Scene scene = small_scene(name);
    ASSERT_TRUE(test::plan_of(scene, PlanRequest{}).has(effect));
    const Image without = render(scene, test::with_switch(PlanRequest{}, effect, Switch::off));
    EXPECT_GT(differing_values(render(scene, PlanRequest{}), without), 0);
}

INSTANTIATE_TEST_SUITE_P(effects, NeededEffect,
                         testing::Values(Needed{"overcast", Effect::voxels},
                                         Needed{"spheres", Effect::spheres}, Needed{"slit", Effect::ao},
                                         Needed{"black_sky", Effect::sun}, Needed{"overcast", Effect::sky},
                                         Needed{"far_hills", Effect::aerial},
                                         Needed{"emitters", Effect::emission}));

}  // namespace
}  // namespace voxilux
