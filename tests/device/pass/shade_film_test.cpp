// The pass film.add: radiance in closed form, and sums that lose nothing.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <numbers>

#include "film/film.h"
#include "plan/film_planes.h"
#include "shared/film_sum.h"
#include "shared/sampling.h"
#include "support/frame_fixture.h"
#include "support/statistics.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

// Three roundings of a float: the products of albedo, irradiance, cosine and 1 / pi may be taken in any
// order.
constexpr float kProductError = 4.0f * 0x1p-24f;

Scene plane_scene() {
    Scene scene = test::white_scene();
    test::add_box(scene, {-40, -40, -1}, {40, 40, 0});
    scene.camera = test::camera_towards({0, -20, 15}, {0, 0, 0}, 60.0);
    scene.settings.size = {24, 20};
    return scene;
}

// A sky, which the radiances of add_radiance() replace.
Scene values_scene(glm::ivec2 size) {
    Scene scene = test::white_scene();
    scene.settings.size = size;
    return scene;
}

std::int64_t fixed(float value) {
    const gpu::FilmFixed converted = gpu::film_fixed(value);
    EXPECT_EQ(converted.flags, 0u);
    return static_cast<std::int64_t>(std::uint64_t{converted.sum.y} << 32 | converted.sum.x);
}

// The square as the film sums it: a product of floats, rounded to 2^-24 once more.
std::int64_t square(float value) {
    const float product = value * value;
    return std::llrint(std::ldexp(static_cast<double>(product), gpu::kFilmFractionBits));
}

TEST(FilmRadiance, plane_under_a_constant_sky_is_albedo_times_radiance_exactly) {
    Scene scene = plane_scene();
    const glm::vec3 albedo(0.1f, 0.37f, 0.83f);
    scene.sky.radiance = glm::vec3(0.9f, 1.1f, 2.3f);
    scene.materials[0].albedo = albedo;
    const test::FramePlanes planes = test::render_first_sample(scene);
    int on_plane = 0;
    for (std::size_t i = 0; i < planes.hits.size(); ++i) {
        const bool is_hit = planes.hits[i].face == 5u;
        on_plane += is_hit ? 1 : 0;
        ASSERT_EQ(planes.color[i], is_hit ? albedo * scene.sky.radiance : scene.sky.radiance);
    }
    EXPECT_GT(on_plane, 200);
    EXPECT_EQ(planes.counters[gpu::kWorkHits], static_cast<gpu::uint>(on_plane));
}

TEST(FilmRadiance, plane_under_sky_and_hard_sun_is_the_closed_form) {
    Scene scene = plane_scene();
    scene.sun = {.azimuth_deg = 70.0f, .elevation_deg = 35.0f, .angular_diameter_deg = 0.0f};
    scene.materials[0].albedo = glm::vec3(0.1f, 0.37f, 0.83f);
    const test::FramePlanes planes = test::render_first_sample(scene);
    const glm::vec3 direct = scene.sun.irradiance * (scene.sun.direction().z / std::numbers::pi_v<float>);
    const glm::vec3 want = scene.materials[0].albedo * (scene.sky.radiance + direct);
    for (std::size_t i = 0; i < planes.hits.size(); ++i) {
        if (planes.hits[i].face != 5u) continue;
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(planes.color[i][c], want[c], kProductError * want[c]);
    }
}

// Convex things in a white furnace: albedo 1, sky 1, nothing occluded, so they vanish, exactly.
TEST(FilmRadiance, convex_things_vanish_in_a_white_furnace) {
    std::vector<Scene> scenes(4, test::white_scene());
    test::add_box(scenes[0], {0, 0, 0}, {1, 1, 1});
    test::add_box(scenes[1], {-5, -3, 0}, {4, 6, 9});
    scenes[2].spheres.push_back({glm::dvec3(0.5, 0.25, 0.125), 3.0, 0});
    scenes[3] = plane_scene();
    for (Scene& scene : scenes) {
        scene.settings.size = {32, 24};
        scene.settings.ao_rays = 8;
        test::FrameFixture fixture(scene);
        for (std::uint32_t sample = 0; sample < 3; ++sample) {
            const test::FramePlanes planes = fixture.render(sample);
            EXPECT_GT(planes.counters[gpu::kWorkHits], 100u);
            for (const glm::vec3& color : planes.color)
                ASSERT_EQ(color, glm::vec3(1.0f));
        }
        for (const std::int64_t sum : fixture.film_sums("beauty_a"))
            ASSERT_EQ(sum, std::int64_t{2} << gpu::kFilmFractionBits);
    }
}

TEST(FilmRadiance, emission_is_added_to_what_is_reflected) {
    Scene scene = plane_scene();
    scene.materials[0].albedo = glm::vec3(0.5f);
    scene.materials[0].emission = glm::vec3(3.0f, 0.25f, 17.0f);
    const test::FramePlanes planes = test::render_first_sample(scene);
    for (std::size_t i = 0; i < planes.hits.size(); ++i) {
        if (planes.hits[i].face != 5u) continue;
        ASSERT_EQ(planes.color[i], glm::vec3(3.5f, 0.75f, 17.5f));
    }
}

TEST(FilmRadiance, inside_of_a_solid_shows_its_emission_only) {
    Scene scene = plane_scene();
    scene.sun.on = true;
    scene.materials[0].emission = glm::vec3(0.0f, 0.5f, 0.0f);
    scene.camera = Camera{.position = glm::dvec3(0.5, 0.5, -0.5)};
    for (const glm::vec3& color : test::render_first_sample(scene).color)
        ASSERT_EQ(color, glm::vec3(0.0f, 0.5f, 0.0f));
}

// Every plane of the film is the exact sum of what the passes wrote, each value rounded once to 2^-24.
TEST(FilmAdd, sums_of_every_plane_are_exact) {
    Scene scene = plane_scene();
    scene.sun.on = true;
    test::add_box(scene, {-3, -3, 0}, {3, 3, 6});
    scene.materials[0].albedo = glm::vec3(0.3f, 0.6f, 0.9f);
    scene.settings.ao_rays = 3;
    test::FrameFixture fixture(scene);
    std::vector<std::int64_t> ao(480), sun(480), a(480 * 3), b(480 * 3), squares(480 * 3);
    for (std::uint32_t sample = 0; sample < 5; ++sample) {
        const test::FramePlanes planes = fixture.render(sample);
        for (std::size_t i = 0; i < 480; ++i) {
            ao[i] += fixed(planes.ao[i]);
            sun[i] += fixed(planes.sun[i]);
            for (std::size_t c = 0; c < 3; ++c)
                (sample % 2 == 0 ? a : b)[3 * i + c] += fixed(planes.color[i][static_cast<int>(c)]);
            for (std::size_t c = 0; c < 3; ++c)
                squares[3 * i + c] += square(planes.color[i][static_cast<int>(c)]);
        }
    }
    EXPECT_EQ(fixture.film_sums("ao"), ao);
    EXPECT_EQ(fixture.film_sums("sun"), sun);
    EXPECT_EQ(fixture.film_sums("beauty_a"), a);
    EXPECT_EQ(fixture.film_sums("beauty_b"), b);
    EXPECT_EQ(fixture.film_sums("squares"), squares);
    squares[77] += 1;
    EXPECT_NE(fixture.film_sums("squares"), squares);
    a[77] += 1;
    EXPECT_NE(fixture.film_sums("beauty_a"), a);
}

TEST(FilmAdd, bad_values_are_counted_and_kept_out_of_the_sums) {
    const std::vector<float> values = {1.5f, std::nanf(""), INFINITY, -INFINITY, 1e9f, -1e9f,
                                       0.0f, -2.0f,         0.25f,    3e38f,     7.0f, -0x1p-24f};
    const std::int64_t most = fixed(gpu::kFilmMaxValue);
    const std::vector<std::int64_t> want = {fixed(1.5f),  0,    0,           0, most, -most, 0, -fixed(2.0f),
                                            fixed(0.25f), most, fixed(7.0f), -1};
    test::FrameFixture fixture(values_scene({2, 2}));
    std::vector<glm::vec3> radiance(4);
    std::memcpy(radiance.data(), values.data(), values.size() * sizeof(float));
    const auto counters = fixture.add_radiance(0, radiance);
    EXPECT_EQ(fixture.film_sums("beauty_a"), want);
    EXPECT_EQ(counters[gpu::kFaultFilmNonFinite], 3u);
    EXPECT_EQ(counters[gpu::kFaultFilmClamped], 3u);
}

// Both halves and the squares of values of any size against 128-bit sums, in an image that ends within a
// group.
TEST(FilmAdd, sums_of_any_values_are_those_of_128_bit_integers) {
    constexpr std::size_t kValues = 3 * 7 * 5;
    test::FrameFixture fixture(values_scene({7, 5}));
    test::TestRandom random(21);
    std::vector<__int128> halves[2] = {std::vector<__int128>(kValues), std::vector<__int128>(kValues)};
    std::vector<__int128> squares(kValues);
    for (std::uint32_t sample = 0; sample < 6; ++sample) {
        std::vector<float> values(kValues);
        for (std::size_t i = 0; i < kValues; ++i) {
            const double sign = i % 3 == 0 ? -1.0 : 1.0;
            values[i] = static_cast<float>(sign * std::exp2(random.uniform(-30.0, 18.9)));
            halves[sample % 2][i] += std::llrint(std::ldexp(static_cast<double>(values[i]), 24));
            squares[i] += square(values[i]);
        }
        std::vector<glm::vec3> radiance(kValues / 3);
        std::memcpy(radiance.data(), values.data(), kValues * sizeof(float));
        const auto counters = fixture.add_radiance(sample, radiance);
        EXPECT_EQ(counters[gpu::kFaultFilmClamped] + counters[gpu::kFaultFilmNonFinite], 0u);
    }
    const auto differences = [](const std::vector<std::int64_t>& sums, const std::vector<__int128>& want,
                                std::int64_t off) {
        std::size_t count = sums.size() == want.size() ? 0 : kValues;
        for (std::size_t i = 0; i < std::min(sums.size(), want.size()); ++i)
            count += std::min<__int128>(want[i], INT64_MAX) == sums[i] + off ? 0 : 1;
        return count;
    };
    EXPECT_EQ(differences(fixture.film_sums("beauty_a"), halves[0], 0), 0u);
    EXPECT_EQ(differences(fixture.film_sums("beauty_b"), halves[1], 0), 0u);
    EXPECT_EQ(differences(fixture.film_sums("squares"), squares, 0), 0u);
    EXPECT_EQ(differences(fixture.film_sums("beauty_a"), halves[0], 1), kValues) << "the negative control";
}

// Tiles that begin and end within a group of pixels.
TEST(FilmAdd, tiles_of_odd_widths_change_no_sum) {
    Scene scene = plane_scene();
    scene.sun.on = true;
    scene.spheres.push_back({glm::dvec3(0.5, 0.25, 3.125), 3.0, 0});
    scene.settings.size = {7, 11};
    test::FrameFixture whole(scene);
    for (std::uint32_t sample = 0; sample < 2; ++sample)
        (void)whole.render(sample);
    std::map<std::string, std::vector<std::int64_t>> want;
    for (const FilmPlane& plane : film_planes(whole.plan()))
        want[plane.name] = whole.film_sums(plane.name);
    for (const std::uint32_t rows : {1u, 2u, 3u, 5u}) {
        test::FrameFixture fixture(scene);
        for (std::uint32_t sample = 0; sample < 2; ++sample)
            fixture.render_tile(sample, rows);
        for (const auto& [name, sums] : want)
            EXPECT_EQ(fixture.film_sums(name), sums) << name << " in tiles of " << rows << " rows";
    }
}

// Surface AOVs are means over samples; position and depth are those of the first.
TEST(FilmSurface, albedo_and_normal_follow_the_hits) {
    Scene scene = plane_scene();
    scene.materials.push_back({.name = "red", .albedo = glm::vec3(0.75f, 0.5f, 0.25f)});
    test::add_box(scene, {-4, -4, 0}, {4, 4, 5}, 1);
    test::FrameFixture fixture(scene);
    const test::FramePlanes planes = fixture.render(0);
    const std::vector<std::int64_t> albedo = fixture.film_sums("albedo");
    const std::vector<std::int64_t> normal = fixture.film_sums("normal");
    for (std::size_t i = 0; i < planes.hits.size(); ++i) {
        const gpu::Hit& hit = planes.hits[i];
        const bool is_hit = hit.face != gpu::kFaceMiss;
        const glm::vec3 want_albedo = is_hit ? scene.materials[hit.material].albedo : glm::vec3(0.0f);
        const glm::vec3 want_normal = is_hit ? gpu::face_normal(hit.face) : glm::vec3(0.0f);
        for (std::size_t c = 0; c < 3; ++c) {
            ASSERT_EQ(albedo[3 * i + c], fixed(want_albedo[static_cast<int>(c)]));
            ASSERT_EQ(normal[3 * i + c], fixed(want_normal[static_cast<int>(c)]));
        }
    }
}

}  // namespace
}  // namespace voxilux
