// Hard cases of whole frames, numbered as in README.md.

#include <gtest/gtest.h>

#include <cstring>

#include "base/error.h"
#include "film/film.h"
#include "formats/scene_toml.h"
#include "frame/frame.h"
#include "plan/film_planes.h"
#include "shared/film_sum.h"
#include "support/frame_fixture.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

namespace fs = std::filesystem;

// A floor with a wall, so that occlusion and shadow differ from pixel to pixel.
Scene walled_scene() {
    Scene scene = test::white_scene();
    test::add_box(scene, {-16, -16, -1}, {16, 16, 0});
    test::add_box(scene, {2, -16, 0}, {4, 16, 9});
    scene.materials[0].albedo = glm::vec3(0.7f, 0.5f, 0.3f);
    scene.sun = {.azimuth_deg = 20.0f, .elevation_deg = 50.0f, .angular_diameter_deg = 5.0f};
    scene.camera = test::camera_towards({-11, -8, 12}, {0, 0, 1}, 50.0);
    scene.settings.size = {40, 33};
    scene.settings.ao_radius = 12.0f;
    return scene;
}

TEST(HardCase, row09_camera_that_is_not_finite_or_farther_than_floats_tell_is_refused) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    for (const double bad : {nan, inf, -inf, 1e30, 8388700.0, -8388700.0}) {
        for (int axis = 0; axis < 3; ++axis) {
            Scene scene = walled_scene();
            scene.camera->position[axis] = bad;
            try {
                test::FrameFixture fixture(scene);
                ADD_FAILURE() << bad << " on axis " << axis << " was not refused";
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ExitCode::input_refused);
            }
        }
    }
}

TEST(HardCase, row18_occlusion_of_our_scenes_is_in_the_unit_interval_and_of_a_plane_one) {
    for (const std::string name : {"plane", "slit", "wall_corner", "mixed", "first_light"}) {
        Scene scene = load_scene(fs::path(VX_SOURCE_DIR) / "scenes" / (name + ".toml"));
        scene.settings.size = {64, 48};
        scene.settings.ao_rays = 16;
        for (const float open : test::render_first_sample(scene).ao) {
            ASSERT_TRUE(open >= 0.0f && open <= 1.0f) << name << " " << open;
            ASSERT_TRUE(name != "plane" || open == 1.0f) << open;
        }
    }
}

// The camera is a thousandth of a voxel above the floor, so every ray grazes.
TEST(HardCase, row18_plane_seen_at_a_grazing_angle_has_occlusion_exactly_one) {
    Scene scene = test::white_scene();
    test::add_box(scene, {-200, -200, -1}, {200, 200, 0});
    scene.camera = Camera{.position = glm::dvec3(0.3, -150.0, 0.001), .yaw_deg = 90.0, .fov_y_deg = 0.01};
    scene.settings.size = {32, 32};
    scene.settings.ao_rays = 64;
    const test::FramePlanes planes = test::render_first_sample(scene);
    EXPECT_GT(planes.counters[gpu::kWorkHits], 100u);
    for (const float open : planes.ao)
        ASSERT_EQ(open, 1.0f);
}

// The film as it is after `samples` samples of one value, then one more added on the device.
std::int64_t sum_after(test::FrameFixture& fixture, std::uint64_t samples, float value) {
    const gpu::FilmFixed fixed = gpu::film_fixed(value);
    const auto each = static_cast<std::int64_t>(std::uint64_t{fixed.sum.y} << 32 | fixed.sum.x);
    fixture.set_film_sums("beauty_a", std::vector(12, each * static_cast<std::int64_t>(samples)));
    fixture.add_radiance(0, std::vector(4, glm::vec3(value)));
    const std::vector<std::int64_t> sums = fixture.film_sums("beauty_a");
    EXPECT_EQ(sums, std::vector(12, each * static_cast<std::int64_t>(samples + 1))) << "after " << samples;
    return sums.front();
}

TEST(HardCase, row22_mean_of_a_constant_stays_constant_past_every_counter_width) {
    Scene scene = test::white_scene();
    scene.settings.size = {4, 1};
    test::FrameFixture fixture(scene);
    for (const float value : {0.7f, -0.3f, 31.25f, 0x1p-24f}) {
        const float kept = film_mean(sum_after(fixture, 0, value), 1);
        for (const std::uint64_t samples :
             {65535ull, 65536ull, (1ull << 20) - 1, (1ull << 24) + 1, (1ull << 32) - 1, (1ull << 32) + 1})
            EXPECT_EQ(film_mean(sum_after(fixture, samples, value), samples + 1), kept)
                << value << " x " << samples;
    }
}

std::vector<float> occlusion(const Scene& scene, std::uint32_t sample) {
    return test::FrameFixture(scene).render(sample).ao;
}

// Correlation of the noise of two pictures around a common mean picture.
double correlation(const std::vector<float>& a, const std::vector<float>& b, const std::vector<float>& mean) {
    double ab = 0.0;
    double aa = 0.0;
    double bb = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double x = static_cast<double>(a[i] - mean[i]);
        const double y = static_cast<double>(b[i] - mean[i]);
        ab += x * y;
        aa += x * x;
        bb += y * y;
    }
    return ab / std::sqrt(aa * bb);
}

std::vector<float> mean_of(const std::vector<std::vector<float>>& pictures) {
    std::vector<float> mean(pictures.front().size(), 0.0f);
    for (const std::vector<float>& picture : pictures) {
        for (std::size_t i = 0; i < mean.size(); ++i)
            mean[i] += picture[i] / static_cast<float>(pictures.size());
    }
    return mean;
}

// Pictures of one scene that must not share their noise. The mean of them all is a little of each, so n
// independent pictures correlate by -1 / (n - 1); a repeated one would by 1.
void expect_unlike(const std::vector<std::vector<float>>& pictures, const std::string& what) {
    const std::vector<float> mean = mean_of(pictures);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_LT(correlation(pictures[i], pictures[j], mean), 0.2) << what << " " << i << " and " << j;
    }
}

TEST(HardCase, row23_seeds_from_zero_to_the_last_give_unlike_noise) {
    for (const Sequence sequence : {Sequence::sobol, Sequence::halton, Sequence::white}) {
        std::vector<std::vector<float>> pictures;
        for (const std::uint32_t seed : {0u, 1u, 2u, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFFFEu, 0xFFFFFFFFu}) {
            Scene scene = walled_scene();
            scene.settings.seed = seed;
            scene.settings.sequence = sequence;
            pictures.push_back(occlusion(scene, 0));
        }
        expect_unlike(pictures, "seeds");
    }
}

// With four rays per sample the ray number passes 2^32 at sample 2^30: the streams must not start over.
TEST(HardCase, row23_samples_at_the_ends_of_the_counters_repeat_no_picture) {
    for (const Sequence sequence : {Sequence::sobol, Sequence::white}) {
        for (const std::uint32_t rays : {1u, 4u}) {
            Scene scene = walled_scene();
            scene.settings.sequence = sequence;
            scene.settings.ao_rays = rays;
            std::vector<std::vector<float>> pictures;
            for (const std::uint32_t sample :
                 {0u, 1u, 0x3FFFFFFFu, 0x40000000u, 0x40000001u, 0x80000000u, 0xFFFFFFFFu})
                pictures.push_back(occlusion(scene, sample));
            expect_unlike(pictures, std::to_string(rays) + " rays, samples");
        }
    }
}

TEST(HardCase, row23_comparison_rejects_a_repeated_picture) {
    Scene scene = walled_scene();
    std::vector<std::vector<float>> pictures;
    for (const std::uint32_t sample : {0u, 1u, 2u, 0u})
        pictures.push_back(occlusion(scene, sample));
    EXPECT_GT(correlation(pictures[0], pictures[3], mean_of(pictures)), 0.9);
}

// Everything that a render leaves in the film after three samples.
std::vector<std::int64_t> film_of(const Scene& scene, std::uint32_t rows, Executor& executor) {
    test::FrameFixture fixture(scene, executor);
    for (std::uint32_t sample = 0; sample < 3; ++sample)
        fixture.render_tile(sample, rows);
    std::vector<std::int64_t> film;
    for (const FilmPlane& plane : film_planes(fixture.plan())) {
        const std::vector<std::int64_t> sums = fixture.film_sums(plane.name);
        film.insert(film.end(), sums.begin(), sums.end());
    }
    return film;
}

TEST(HardCase, row24_film_is_the_same_for_any_slices_and_groups) {
    Scene scene = walled_scene();
    scene.spheres.push_back({glm::dvec3(-3.0, 4.0, 2.5), 2.0, 0});
    const std::vector<std::int64_t> whole = film_of(scene, 33, test_executor());
    for (const std::uint32_t rows : {1u, 2u, 7u, 8u, 17u})
        EXPECT_EQ(film_of(scene, rows, test_executor()), whole) << rows << " rows per dispatch tile";
    for (const std::array<std::uint32_t, 2> group : {std::array{16u, 16u}, {32u, 1u}, {3u, 5u}}) {
        Executor executor(test_device(), all_shaders(), {.group_size = group, .poison_transients = true});
        EXPECT_EQ(film_of(scene, 33, executor), whole) << group[0] << "x" << group[1];
    }
    scene.settings.seed += 1;
    EXPECT_NE(film_of(scene, 33, test_executor()), whole) << "another seed must show";
}

TEST(HardCase, row45_camera_inside_a_solid_is_drawn_dark_and_said) {
    Scene scene = walled_scene();
    scene.camera = Camera{.position = glm::dvec3(3.0, 0.5, 4.5)};
    const RenderOutcome outcome = test::render_validated(scene);
    for (const float pixel : outcome.image.channels.at("R").pixels)
        ASSERT_EQ(pixel, 0.0f);
    ASSERT_EQ(outcome.statistics.warnings.size(), 1u);
    EXPECT_NE(outcome.statistics.warnings[0].find("inside a solid"), std::string::npos);
}

TEST(HardCase, row45_fields_of_view_from_nothing_to_half_space_and_vertical_views_render_without_faults) {
    for (const double fov : {1e-12, 1e-3, 179.0, 179.999999}) {
        for (const double pitch : {-90.0, 0.0, 90.0}) {
            Scene scene = walled_scene();
            scene.camera =
                Camera{.position = glm::dvec3(-4.5, 0.5, 4.5), .pitch_deg = pitch, .fov_y_deg = fov};
            for (const glm::vec3& color : test::render_first_sample(scene).color)
                ASSERT_TRUE(std::isfinite(color.x + color.y + color.z)) << fov << " " << pitch;
        }
    }
}

}  // namespace
}  // namespace voxilux
