// Prices of effects where the difference is known: in closed form, or to the bit.

#include <gtest/gtest.h>

#include <cstring>
#include <numbers>

#include "estimators/metrics.h"
#include "jobs/effect_price.h"
#include "support/frame_fixture.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

// Relative; the pictures are stored as the floats nearest to exact means (analytic plane).
constexpr double kRoundingError = 1e-5;

// The plane, seen by more pixels.
Scene lit_plane(float angular_diameter_deg) {
    Scene scene = test::lit_plane(angular_diameter_deg);
    scene.settings.size = {48, 48};
    return scene;
}

// sqrt(relMSE) of the picture without sun against albedo (sky + irradiance cosine / pi); the cosine is that
// of the mean over a disc of half angle r, sin(elevation) (1 + cos r) / 2.
double error_without_sun(const Scene& scene) {
    const double r = static_cast<double>(scene.sun.angular_diameter_deg) * std::numbers::pi / 360.0;
    const double cosine = static_cast<double>(scene.sun.direction().z) * (1.0 + std::cos(r)) / 2.0;
    double sum = 0.0;
    for (int c = 0; c < 3; ++c) {
        const double albedo = static_cast<double>(scene.materials[0].albedo[c]);
        const double sun = albedo * static_cast<double>(scene.sun.irradiance[c]) * cosine / std::numbers::pi;
        const double all = albedo * static_cast<double>(scene.sky.radiance[c]) + sun;
        sum += sun * sun / (all * all + kRelMseEpsilon) / 3.0;
    }
    return std::sqrt(sum);
}

RenderOptions validated() {
    return {.device = {.validation = true}};
}

std::vector<EffectPrice> prices_of(const Scene& scene, std::vector<Effect> effects = {},
                                   const PlanRequest& request = {}) {
    RenderSession session(scene, validated());
    const std::vector<EffectPrice> prices = price_effects(
        session,
        {.settings = scene.settings, .request = request, .samples = 2, .effects = std::move(effects)});
    EXPECT_EQ(session.end(), std::vector<std::string>{});
    return prices;
}

EffectPrice price_of(const Scene& scene, Effect effect) {
    const std::vector<EffectPrice> prices = prices_of(scene, {effect});
    EXPECT_EQ(prices.size(), 1u);
    return prices.front();
}

TEST(EffectPrice, of_a_hard_sun_on_a_plane_is_the_closed_form) {
    const Scene scene = lit_plane(0.0f);
    const EffectPrice price = price_of(scene, Effect::sun);
    EXPECT_TRUE(price.on);
    EXPECT_TRUE(price.is_beyond_noise);
    EXPECT_NEAR(price.error, error_without_sun(scene), kRoundingError);
}

TEST(EffectPrice, of_a_soft_sun_on_a_plane_is_within_its_interval) {
    Scene scene = lit_plane(24.0f);
    scene.settings.sequence = Sequence::white;
    const EffectPrice price = price_of(scene, Effect::sun);
    const double truth = error_without_sun(scene);
    EXPECT_LE(price.error_low, truth);
    EXPECT_GE(price.error_high, truth);
    EXPECT_LT(price.error_high - price.error_low, 0.05 * truth);
}

// Negative control: the closed form for a sun five degrees higher lies outside.
TEST(EffectPrice, of_a_soft_sun_rejects_another_elevation) {
    Scene scene = lit_plane(24.0f);
    scene.settings.sequence = Sequence::white;
    const EffectPrice price = price_of(scene, Effect::sun);
    scene.sun.elevation_deg += 5.0f;
    EXPECT_GT(error_without_sun(scene), price.error_high);
}

TEST(EffectPrice, of_occlusion_on_a_plane_is_zero_in_error_and_not_in_time) {
    Scene scene = lit_plane(0.0f);
    // So many rays that they take most of the time, even on a busy machine.
    scene.settings.size = {128, 128};
    scene.settings.ao_rays = 64;
    const EffectPrice price = price_of(scene, Effect::ao);
    EXPECT_TRUE(price.on);
    EXPECT_EQ(price.error, 0.0);
    EXPECT_EQ(price.error_high, 0.0);
    EXPECT_FALSE(price.is_beyond_noise);
    EXPECT_LE(price.ms_low, price.ms_per_sample);
    EXPECT_LE(price.ms_per_sample, price.ms_high);
    EXPECT_GT(price.ms_high, 0.0);
}

Scene pillar_in_space() {
    Scene scene = lit_plane(0.53f);
    test::add_box(scene, {-3, -3, 0}, {3, 3, 9});
    scene.sky.radiance = glm::vec3(0.0f);
    return scene;
}

TEST(EffectPrice, of_occlusion_forced_under_a_black_sky_is_exactly_zero) {
    const EffectPrice price = price_of(pillar_in_space(), Effect::ao);
    EXPECT_FALSE(price.on);
    EXPECT_FALSE(price.by_choice);
    EXPECT_EQ(price.error, 0.0);
    EXPECT_EQ(price.error_high, 0.0);
    EXPECT_FALSE(price.is_beyond_noise);
}

// Negative control: under a sky the same occlusion changes the picture, although its rays are noisy.
TEST(EffectPrice, of_occlusion_under_a_sky_is_beyond_noise) {
    Scene scene = pillar_in_space();
    scene.sky.radiance = glm::vec3(1.0f);
    const EffectPrice price = price_of(scene, Effect::ao);
    EXPECT_TRUE(price.on);
    EXPECT_TRUE(price.is_beyond_noise);
    EXPECT_GT(price.error_low, 0.01);
}

TEST(EffectPrice, of_sunlight_between_surfaces_is_left_out_by_choice_and_shows) {
    const EffectPrice price = price_of(pillar_in_space(), Effect::indirect);
    EXPECT_FALSE(price.on);
    EXPECT_TRUE(price.by_choice);
    EXPECT_TRUE(price.is_beyond_noise);
}

TEST(EffectPrice, of_all_effects_has_those_that_can_be_switched_in_order) {
    const Scene scene = pillar_in_space();
    std::vector<Effect> priced;
    for (const EffectPrice& price : prices_of(scene))
        priced.push_back(price.effect);
    EXPECT_EQ(priced,
              (std::vector<Effect>{Effect::voxels, Effect::ao, Effect::sun, Effect::indirect, Effect::aov}));
}

TEST(EffectPrice, of_a_stopped_job_is_nothing) {
    const Scene scene = lit_plane(0.0f);
    RenderSession session(scene, validated());
    EXPECT_TRUE(price_effects(session, {.settings = scene.settings, .stops = [] { return true; }}).empty());
}

bool has_same_colours(const Image& a, const Image& b) {
    for (const char* name : {"R", "G", "B"}) {
        const std::vector<float>& x = a.channels.at(name).pixels;
        const std::vector<float>& y = b.channels.at(name).pixels;
        if (x.size() != y.size() || std::memcmp(x.data(), y.data(), x.size() * sizeof(float)) != 0)
            return false;
    }
    return true;
}

struct Change {
    const char* name;
    RenderSettings settings;
    EffectRequest effects;
};

std::vector<Change> changes(const RenderSettings& settings) {
    std::vector<Change> all(7, Change{.settings = settings});
    all[0].name = "another seed";
    all[0].settings.seed = 9;
    all[1].name = "shared occlusion";
    all[1].settings.ao.method = AoMethod::hash;
    all[2].name = "shared occlusion in narrower cells";
    all[2].settings.ao = {.method = AoMethod::hash, .cell_px = 3.0f};
    all[3].name = "no voxels";
    all[3].effects.switches[Effect::voxels] = Switch::off;
    all[4].name = "photons of the sun";
    all[4].effects.switches[Effect::indirect] = Switch::on;
    all[5].name = "fewer photons with radii of their own";
    all[5].effects.switches[Effect::indirect] = Switch::on;
    all[5].settings.photons.count = 20000;
    all[5].settings.photons.classic = true;
    all[6].name = "as it was";
    return all;
}

TEST(ChangedSessionNightly, renders_what_a_new_session_renders) {
    Scene scene = pillar_in_space();
    scene.sky.radiance = glm::vec3(1.0f);
    scene.settings.spp = 3;
    RenderSession session(scene, validated());
    (void)session.render(0, std::nullopt);
    for (const Change& change : changes(scene.settings)) {
        Scene other = scene;
        other.settings = change.settings;
        const PlanRequest request{.effects = change.effects};
        session.change(change.settings, request);
        const RenderOutcome changed = session.render(0, std::nullopt);
        RenderOptions options = validated();
        options.plan = request;
        const RenderOutcome fresh = render_scene(other, options);
        EXPECT_EQ(changed.plan, fresh.plan) << change.name;
        EXPECT_TRUE(has_same_colours(changed.image, fresh.image)) << change.name;
    }
    EXPECT_EQ(session.end(), std::vector<std::string>{});
}

// Negative control: the comparison notices a change.
TEST(ChangedSession, renders_something_else_with_another_seed) {
    Scene scene = pillar_in_space();
    scene.sky.radiance = glm::vec3(1.0f);
    scene.settings.spp = 1;
    RenderSession session(scene, validated());
    const RenderOutcome first = session.render(0, std::nullopt);
    ++scene.settings.seed;
    session.change(scene.settings, {});
    EXPECT_FALSE(has_same_colours(first.image, session.render(0, std::nullopt).image));
}

}  // namespace
}  // namespace voxilux
