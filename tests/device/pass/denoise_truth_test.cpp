// Denoised pictures against converged ones: how much better they are, and whether their estimated errors are
// right.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "estimators/metrics.h"
#include "formats/exr.h"
#include "formats/scene_toml.h"
#include "scene/scene_camera.h"
#include "support/device_fixture.h"
#include "support/frame_fixture.h"
#include "support/light_scenes.h"
#include "support/shared_data.h"

namespace voxilux::test {
namespace {

double relmse_of(const Image& reference, const Image& image) {
    return measure_difference(reference, image, selected_pixels(image.width, image.height, {})).relmse;
}

RenderOutcome denoised_outcome(Scene scene, std::uint32_t samples, std::uint32_t seed) {
    scene.settings.spp = samples;
    scene.settings.seed = seed;
    return render_validated(scene, {.plan = {.wants_denoised = true}});
}

RenderOutcome outcome_within(Scene scene, double error, std::uint32_t seed) {
    scene.settings.spp = 4096;
    scene.settings.seed = seed;
    return render_validated(scene, {.plan = {.wants_denoised = true}, .error_target = error});
}

double denoised_relmse(const Image& truth, const RenderOutcome& outcome) {
    return relmse_of(truth, shown_picture(outcome.denoised.value(), outcome.image));
}

// How often the estimates held.
struct Claims {
    int made = 0, broken = 0, broken_by_halves = 0;

    // `own`: relMSE that the truth itself has.
    void add(const Denoised& denoised, double relmse, double own) {
        if (!denoised.is_filtered()) return;  // otherwise the estimate is that of the plain picture
        const double error = std::sqrt(std::max(relmse - own, 0.0));
        ++made;
        broken += error > denoised.claim.high ? 1 : 0;
        broken_by_halves += error > 0.5 * denoised.claim.high ? 1 : 0;
    }
};

// A court with walls, a slab on pillars and an emitter, one voxel thin things among them.
Scene court_scene(int width) {
    Scene scene = white_scene();
    scene.settings = {.size = {width, width * 3 / 4}};
    add_box(scene, {-12, -12, -1}, {12, 12, 0}, add_diffuse(scene, 0.6f));
    add_box(scene, {-12, 11, 0}, {12, 12, 9},
            add_material(scene, {.name = "red", .albedo = {0.7f, 0.2f, 0.1f}}));
    add_box(scene, {-12, -12, 0}, {-11, 11, 9}, add_diffuse(scene, 0.3f));
    add_box(scene, {-4, -2, 6}, {5, 5, 7});
    for (const glm::ivec2 place : {glm::ivec2(-4, -2), {4, -2}, {-4, 4}, {4, 4}})
        add_box(scene, {place, 0}, {place.x + 1, place.y + 1, 6});
    add_box(scene, {-9, 8, 1}, {-8, 9, 2}, add_emitter(scene, 8.0f));
    scene.sky.radiance = glm::vec3(0.3f, 0.4f, 0.6f);
    scene.sun.on = true;
    scene.camera = camera_towards({22, -26, 16}, {-1, 2, 3});
    return scene;
}

TEST(DenoiseTruthNightly, claims_hold_and_pictures_gain) {
    const Scene scene = court_scene(48);
    const RenderOutcome truth = denoised_outcome(scene, 256, 77);
    const double own = truth.statistics.error.estimate * truth.statistics.error.estimate;
    Claims claims;
    for (const auto& [samples, gain] : {std::pair{8u, 1.4}, {32u, 1.15}}) {
        for (std::uint32_t seed = 1; seed <= 3; ++seed) {
            const RenderOutcome outcome = denoised_outcome(scene, samples, seed);
            const double found = denoised_relmse(truth.image, outcome);
            claims.add(outcome.denoised.value(), found, own);
            EXPECT_LT(gain * found, relmse_of(truth.image, outcome.image)) << samples << " " << seed;
        }
    }
    EXPECT_EQ(claims.broken, 0);
    EXPECT_GE(claims.broken_by_halves, 1) << "the negative control: claims of half as much";
}

TEST(DenoiseTruth, leaves_the_plain_picture_alone) {
    const Scene scene = court_scene(32);
    const RenderOutcome with = denoised_outcome(scene, 4, 1);
    Scene plain = scene;
    plain.settings.spp = 4;
    plain.settings.seed = 1;
    const RenderOutcome without = render_validated(plain);
    for (const char* channel : {"R", "G", "B", "error.Y"})
        EXPECT_EQ(with.image.channels.at(channel).pixels, without.image.channels.at(channel).pixels)
            << channel;
    EXPECT_FALSE(without.denoised.has_value());
    EXPECT_NE(shown_picture(*with.denoised, with.image).channels.at("R").pixels,
              without.image.channels.at("R").pixels);
}

// Turned and zoomed.
Scene seen_from(Scene scene, double yaw_deg, double pitch_deg, double zoom) {
    scene.settings.size = {48, 36};
    scene.camera = camera_of(scene);
    scene.camera->yaw_deg += yaw_deg;
    scene.camera->pitch_deg += pitch_deg;
    scene.camera->fov_y_deg *= zoom;
    return scene;
}

std::vector<Scene> twenty_views() {
    std::vector<Scene> scenes = {court_scene(48)}, views;
    for (const std::string name : {"first_light", "emitters", "wall_corner", "noon"})
        scenes.push_back(load_scene(VX_SOURCE_DIR "/scenes/" + name + ".toml"));
    for (const Scene& scene : scenes)
        for (const glm::dvec3 view : {glm::dvec3(0, 0, 1), {8, 0, 0.6}, {-8, 3, 0.6}, {0, -4, 0.35}})
            views.push_back(seen_from(scene, view.x, view.y, view.z));
    return views;
}

// render(scene, seed): the outcomes whose claims are counted.
template <typename Render>
Claims claims_of_twenty_views(const Render& render) {
    Claims claims;
    for (const Scene& seen : twenty_views()) {
        const RenderOutcome truth = denoised_outcome(seen, 2048, 77);
        const double own = truth.statistics.error.estimate * truth.statistics.error.estimate;
        for (std::uint32_t seed = 1; seed <= 5; ++seed) {
            const RenderOutcome outcome = render(seen, seed);
            claims.add(outcome.denoised.value(), denoised_relmse(truth.image, outcome), own);
        }
    }
    testing::Test::RecordProperty("broken", claims.broken);
    return claims;
}

TEST(DenoiseTruthNightly, claims_hold_in_95_of_100_pictures_of_20_views) {
    const Claims claims = claims_of_twenty_views(
        [](const Scene& seen, std::uint32_t seed) { return denoised_outcome(seen, 16, seed); });
    EXPECT_GE(claims.made, 90);
    EXPECT_LE(claims.broken, 5);
    EXPECT_GT(claims.broken_by_halves, 5) << "the negative control: claims of half as much";
}

// Looking until the claim is low enough would favour claims that are too low.
TEST(DenoiseTruthNightly, claims_that_end_a_render_hold_in_95_of_100) {
    const Claims claims = claims_of_twenty_views(
        [](const Scene& seen, std::uint32_t seed) { return outcome_within(seen, 0.03, seed); });
    EXPECT_GE(claims.made, 80);
    EXPECT_LE(claims.broken, 5);
    EXPECT_GT(claims.broken_by_halves, 5) << "the negative control: claims of half as much";
}

struct GainCase {
    std::string scene;
    double gain16;  // plain relMSE over that of the denoised picture, at 16 samples
    double gain128;
    double own;  // relMSE of the truth
};

void PrintTo(const GainCase& one, std::ostream* out) {
    *out << one.scene;
}

class DenoiseTruthExternal : public testing::TestWithParam<GainCase> {
  protected:
    void SetUp() override { SKIP_WITHOUT_SHARED_DATA(); }
};

// The gains are nine tenths of the least of three seeds.
TEST_P(DenoiseTruthExternal, gains_and_claims) {
    const auto folder = shared_data() / "data" / "gi";
    const Image truth = read_exr(folder / (GetParam().scene + ".exr"));
    const Scene scene = load_scene(folder / (GetParam().scene + ".toml"));
    Claims claims;
    for (const auto& [samples, gain] : {std::pair{16u, GetParam().gain16}, {128u, GetParam().gain128}}) {
        for (std::uint32_t seed = 1; seed <= 2; ++seed) {
            const RenderOutcome outcome = denoised_outcome(scene, samples, seed);
            const double plain = relmse_of(truth, outcome.image), found = denoised_relmse(truth, outcome);
            claims.add(outcome.denoised.value(), found, GetParam().own);
            EXPECT_GT(plain, gain * found) << samples << " samples, seed " << seed << ": " << found;
        }
    }
    EXPECT_EQ(claims.broken, 0);
}

INSTANTIATE_TEST_SUITE_P(, DenoiseTruthExternal, testing::Values(GainCase{"pillars", 2.6, 1.6, 1.4e-5}),
                         testing::PrintToStringParamName());
INSTANTIATE_TEST_SUITE_P(Nightly, DenoiseTruthExternal,
                         testing::Values(GainCase{"courtyard", 8.0, 3.5, 1.8e-5},
                                         GainCase{"room", 20.0, 14.0, 5.7e-5},
                                         GainCase{"maze", 6.0, 2.8, 8.3e-5},
                                         GainCase{"corner", 12.0, 3.0, 2.7e-6}),
                         testing::PrintToStringParamName());

// Negative control: a guide that is the same everywhere hides planes, so light is blurred over edges and less
// is gained.
TEST(DenoiseGuidesExternal, gain_what_they_should) {
    SKIP_WITHOUT_SHARED_DATA();
    const auto folder = shared_data() / "data" / "gi";
    const Image truth = read_exr(folder / "pillars.exr");
    const RenderOutcome outcome = denoised_outcome(load_scene(folder / "pillars.toml"), 16, 1);
    FilmSums film = outcome.film.value();
    for (const char* half : {"_a", "_b"}) {
        std::ranges::fill(film.sums.at(std::string("guide_normal") + half), std::int64_t{1} << 24);
        std::ranges::fill(film.sums.at(std::string("guide_offset") + half), 0);
    }
    const Denoised blind = denoise_film(film, test_executor());
    EXPECT_GT(relmse_of(truth, shown_picture(blind, outcome.image)), 1.3 * denoised_relmse(truth, outcome));
}

}  // namespace
}  // namespace voxilux::test
