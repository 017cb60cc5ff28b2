// The guides that the film sums for the denoiser.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "film/film.h"
#include "support/frame_fixture.h"
#include "support/light_scenes.h"

namespace voxilux::test {
namespace {

using Sums = std::vector<std::int64_t>;

// A box on a floor, seen from above at a height of 20 voxels.
Scene box_scene() {
    Scene scene = white_scene();
    scene.settings = {.size = {31, 22}, .spp = 5};
    add_box(scene, {-30, -30, -1}, {30, 30, 0}, add_diffuse(scene, 0.6f));
    add_box(scene, {-4, -4, 0}, {4, 4, 5});
    scene.camera = camera_towards({9, -14, 20}, {0, 0, 0}, 30.0);
    scene.sky.radiance = glm::vec3(0.0f);
    scene.sun.on = true;
    scene.settings.paths.indirect = false;
    return scene;
}

FilmSums film_of(const Scene& scene, EffectRequest effects) {
    effects.wants_aov = true;
    return render_validated(scene, {.plan = {.effects = std::move(effects), .wants_denoised = true}})
        .film.value();
}

const EffectRequest kSunOnly{.switches = {{Effect::indirect, Switch::off}, {Effect::ao, Switch::off}}};

Sums both_halves(const FilmSums& film, const std::string& plane) {
    Sums sums = film.sums.at(plane + "_a");
    std::ranges::transform(sums, film.sums.at(plane + "_b"), sums.begin(), std::plus());
    return sums;
}

TEST(DenoiseGuide, halves_add_up_to_albedo_and_normal) {
    const FilmSums film = film_of(box_scene(), kSunOnly);
    EXPECT_EQ(both_halves(film, "guide_albedo"), film.sums.at("albedo"));
    EXPECT_EQ(both_halves(film, "guide_normal"), film.sums.at("normal"));
    EXPECT_NE(film.sums.at("guide_albedo_a"), film.sums.at("albedo"));
}

TEST(DenoiseGuide, sunlight_is_all_sharp_and_the_light_of_the_sky_is_not) {
    Scene scene = box_scene();
    const FilmSums sunlit = film_of(scene, kSunOnly);
    for (const std::string half : {"_a", "_b"})
        EXPECT_EQ(sunlit.sums.at("guide_sharp" + half), sunlit.sums.at("beauty" + half));
    scene.sky.radiance = glm::vec3(0.5f);
    const FilmSums both = film_of(scene, {.switches = {{Effect::indirect, Switch::off}}});
    const Sums &sharp = both.sums.at("guide_sharp_a"), &beauty = both.sums.at("beauty_a");
    EXPECT_EQ(sharp, sunlit.sums.at("guide_sharp_a")) << "no ray of this picture misses";
    EXPECT_TRUE(std::ranges::equal(sharp, beauty, std::less_equal()));
    EXPECT_NE(sharp, beauty);
}

TEST(DenoiseGuide, offset_is_that_of_the_plane) {
    Scene scene = box_scene();
    scene.camera = camera_towards({0.5, -12.0, 20.0}, {0.5, -11.9, 0.0}, 10.0);  // the floor alone
    const FilmSums film = film_of(scene, kSunOnly);
    for (std::size_t i = 0; i < film.sums.at("guide_offset_a").size(); ++i)
        ASSERT_EQ(film_mean(film.sums.at("guide_offset_a")[i], film.even[0]), -20.0f);
}

// Otherwise only pixels along its contours would be averaged, and show as rings.
TEST(DenoiseGuide, offset_of_a_sphere_is_one_number_and_its_normals_are_many) {
    Scene scene = white_scene();
    scene.settings = {.size = {16, 12}, .spp = 2};
    scene.spheres.push_back({.centre = {0.0, 0.0, 0.0}, .radius = 5.0, .material = add_diffuse(scene, 0.6f)});
    scene.camera = camera_towards({0.0, -20.0, 0.0}, {0.0, 0.0, 0.0}, 10.0);  // the sphere alone
    const FilmSums film = film_of(scene, kSunOnly);
    const Sums& offsets = film.sums.at("guide_offset_a");
    EXPECT_LT(offsets.front(), 0) << "it faces the camera";
    EXPECT_EQ(std::ranges::count(offsets, offsets.front()), std::ranges::ssize(offsets));
    const Sums& normals = film.sums.at("guide_normal_a");
    EXPECT_LT(std::ranges::count(normals, normals.front()), 10);
}

TEST(DenoiseGuide, follows_a_mirror_to_what_is_shaded) {
    Scene scene = white_scene();
    scene.settings = {.size = {16, 12}, .spp = 2};
    add_box(scene, {-30, -30, -1}, {30, 30, 0}, add_mirror(scene));
    add_box(scene, {-30, -30, 40}, {30, 30, 41}, add_diffuse(scene, 0.6f));
    scene.camera = camera_towards({0.0, 0.0, 20.0}, {0.0, 1.0, 0.0}, 20.0);
    const FilmSums film = film_of(scene, {});
    EXPECT_NEAR(film_mean(film.sums.at("guide_normal_a")[2], film.even[0]), -1.0f, 1e-6f) << "the ceiling's";
    EXPECT_NEAR(film_mean(film.sums.at("guide_albedo_a")[0], film.even[0]), 0.6f, 1e-3f);
    EXPECT_NEAR(film_mean(film.sums.at("normal")[2], film.even[0] + film.odd[0]), 1.0f, 1e-6f)
        << "the mirror's";
}

TEST(DenoiseGuide, is_summed_for_nobody_else) {
    const RenderOutcome outcome = render_validated(box_scene(), {.plan = {.effects = {.wants_aov = true}}});
    for (const PassTime& pass : outcome.statistics.passes)
        EXPECT_FALSE(pass.label.starts_with("denoise.")) << pass.label;
    EXPECT_FALSE(outcome.denoised.has_value());
}

}  // namespace
}  // namespace voxilux::test
