// Renders to an error target: what decides their sample counts, and what the pilot predicts.

#include <gtest/gtest.h>

#include "jobs/error_pilot.h"
#include "jobs/noise_shares.h"
#include "jobs/render_session.h"
#include "passes/upload.h"
#include "renderer/pilot_film.h"
#include "support/device_fixture.h"
#include "support/frame_fixture.h"
#include "support/test_scenes.h"

namespace voxilux::test {
namespace {

// A floor and a wall, seen from above so that the only voxel edge in the picture is that of the wall.
Scene yard() {
    Scene scene = white_scene();
    scene.settings = {.size = {40, 24}, .spp = 4096};
    scene.settings.ao.method = AoMethod::brute;
    add_box(scene, {-40, -40, -1}, {40, 40, 0});
    add_box(scene, {12, -40, 0}, {14, 40, 12});
    scene.camera = camera_down({0.0, 0.0, 30.0}, 30.0);
    scene.sun = {.azimuth_deg = 0.0f, .elevation_deg = 30.0f, .angular_diameter_deg = 20.0f};
    scene.sun.irradiance = glm::vec3(2.0f);
    return scene;
}

RenderOutcome render_to(double error, const Scene& scene) {
    RenderOptions options;
    options.error_target = error;
    return render_validated(scene, options);
}

// A scene on the test device, in the state in which a pilot begins.
struct Stage {
    Scene scene;
    PreparedScene prepared;

    explicit Stage(const Scene& from) : scene(from) {
        PlanRequest request;
        request.wants_error = true;
        prepared = prepare_scene(scene, request, test_device().limits());
        Recording upload;
        record_scene_upload(prepared.plan, scene, prepared.march_world, prepared.lights, upload);
        (void)test_executor().run(upload);
    }
    [[nodiscard]] ErrorPilot pilot(double error) const {
        return run_error_pilot({.prepared = prepared, .scene = scene, .error = error}, test_executor());
    }
    [[nodiscard]] std::vector<NoiseShare> shares() const {
        return share_noise({.prepared = prepared, .scene = scene, .budget_s = 1e9}, test_executor());
    }
    [[nodiscard]] FilmSums film(std::uint32_t samples) const {
        PilotFilm film(prepared.plan, prepared, scene, test_executor(), true);
        for (std::uint32_t i = 0; i < samples; ++i)
            (void)film.take(i);
        return film.read();
    }
};

double share_of(const std::vector<NoiseShare>& shares, Effect effect) {
    const auto found = std::ranges::find(shares, effect, &NoiseShare::effect);
    return found == shares.end() ? 0.0 : found->share.value_or(-1.0);
}

TEST(ErrorStop, picture_is_that_of_its_number_of_samples) {
    Scene scene = yard();
    const RenderOutcome stopped = render_to(0.1, scene);
    EXPECT_EQ(stopped.statistics.stop, StopReason::error_target);
    EXPECT_LE(stopped.statistics.error.high, 0.1);
    scene.settings.spp = stopped.statistics.samples;
    const RenderOutcome whole = render_validated(scene);
    for (const char* channel : {"R", "G", "B", "sampleCount.Y"})
        EXPECT_EQ(stopped.image.channels.at(channel).pixels, whole.image.channels.at(channel).pixels);
    scene.settings.spp += 1;  // negative control
    EXPECT_NE(stopped.image.channels.at("R").pixels, render_validated(scene).image.channels.at("R").pixels);
}

TEST(ErrorStop, pilot_decides_before_the_first_sample) {
    const RenderOutcome outcome = render_to(0.1, yard());
    ASSERT_TRUE(outcome.statistics.forecast);
    EXPECT_TRUE(outcome.statistics.forecast->is_reachable);
    EXPECT_LE(outcome.statistics.samples, 1.5 * outcome.statistics.forecast->samples_high);  // few pixels
    if (outcome.statistics.rounds == 1) {
        EXPECT_EQ(outcome.statistics.decided_by, DecidedBy::pilot);
        EXPECT_EQ(outcome.statistics.samples, outcome.statistics.forecast->samples);
    } else {
        EXPECT_EQ(outcome.statistics.decided_by, DecidedBy::averaged);
    }
}

TEST(ErrorStop, smaller_error_takes_more_samples) {
    EXPECT_GT(render_to(0.02, yard()).statistics.samples, 2 * render_to(0.08, yard()).statistics.samples);
}

TEST(ErrorStop, error_out_of_reach_takes_the_samples_allowed) {
    Scene scene = yard();
    scene.settings.spp = 24;
    const RenderOutcome outcome = render_to(1e-5, scene);
    EXPECT_EQ(outcome.statistics.stop, StopReason::finished);
    EXPECT_EQ(outcome.statistics.samples, 24u);
    EXPECT_FALSE(outcome.statistics.forecast->is_reachable);
}

TEST(ErrorStop, later_frames_are_sized_by_the_one_before) {
    RenderOptions options;
    options.error_target = 0.1;
    Scene scene = yard();
    scene.animation.turntable = Turntable{.frames = 360};
    RenderSession session(scene, options);
    EXPECT_TRUE(session.render(1, {}).statistics.forecast);
    const RenderStatistics second = session.render(2, {}).statistics;
    EXPECT_FALSE(second.forecast);
    EXPECT_NE(second.decided_by, DecidedBy::pilot);
    EXPECT_LE(second.error.high, 0.1);
    EXPECT_LE(second.rounds, 3u);
}

TEST(ErrorPilotOnDevice, decides_alike_in_two_runs) {
    const Stage stage(yard());
    const ErrorPilot first = stage.pilot(0.1), second = stage.pilot(0.1);
    ASSERT_EQ(first.points.size(), second.points.size());
    for (std::size_t i = 0; i < first.points.size(); ++i)
        EXPECT_EQ(first.points[i].noise_high, second.points[i].noise_high);
    EXPECT_GE(first.samples, kMinPilotSamples);
}

TEST(ErrorPilotOnDevice, has_random_numbers_of_its_own) {
    Scene scene = yard();
    const Stage stage(scene);
    RenderOptions options;
    options.keeps_film = true;
    scene.settings.spp = 4;
    const FilmSums render = render_validated(scene, options).film.value();
    EXPECT_NE(stage.film(4).sums.at("beauty_a"), render.sums.at("beauty_a"));
    scene.settings.seed =
        pilot_seed(scene.settings.seed);  // negative control: a render with the pilot's seed
    EXPECT_EQ(stage.film(4).sums.at("beauty_a"),
              render_validated(scene, options).film.value().sums.at("beauty_a"));
}

TEST(NoiseShares, one_effect_with_noise_has_all_of_it) {
    Scene scene = yard();
    scene.sky.radiance = glm::vec3(0.0f);  // no occlusion
    EXPECT_NEAR(share_of(Stage(scene).shares(), Effect::sun), 1.0, 0.05);
    scene = yard();
    scene.sun.on = false;
    EXPECT_NEAR(share_of(Stage(scene).shares(), Effect::ao), 1.0, 0.05);
}

TEST(NoiseShares, shares_of_what_adds_up_add_up) {
    const auto shares = Stage(yard()).shares();
    const double ao = share_of(shares, Effect::ao), sun = share_of(shares, Effect::sun);
    EXPECT_GT(ao, 0.02);
    EXPECT_GT(sun, 0.02);
    EXPECT_NEAR(ao + sun, 1.0, 0.05);
}

TEST(NoiseShares, other_random_numbers_are_caught) {
    Scene scene = yard();
    scene.sky.radiance = glm::vec3(0.0f);
    const FilmSums with = Stage(scene).film(4);
    scene.settings.seed = 1;
    const FilmSums other = Stage(scene).film(4);
    EXPECT_EQ(noise_share(with, with), 0.0);  // what changes nothing has no noise
    EXPECT_GT(noise_share(with, other), 0.5);
}

TEST(NoiseShares, what_cannot_be_told_has_a_reason) {
    for (const NoiseShare& share : Stage(yard()).shares())
        EXPECT_NE(share.share.has_value(), !share.reason.empty()) << name_of(share.effect);
    const Stage stage(yard());
    for (const NoiseShare& share :
         share_noise({.prepared = stage.prepared, .scene = stage.scene, .sample_s = 1.0, .budget_s = 0.5},
                     test_executor()))
        EXPECT_FALSE(share.share) << name_of(share.effect);
}

}  // namespace
}  // namespace voxilux::test
