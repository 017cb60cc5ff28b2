// Light of emitters, glass and mirrors against closed forms.

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "shared/counters.h"
#include "support/frame_fixture.h"
#include "support/light_pictures.h"
#include "support/light_scenes.h"

namespace voxilux {
namespace {

using test::LightPicture;
using test::TruthPixel;

constexpr double kPi = std::numbers::pi;
constexpr double kFarOff = 4.0;     // standard deviations; normal noise passes them once in 16000 times
constexpr double kRounding = 2e-5;  // relative, of chains of floats

// Where the middle of each pixel of a picture that looks straight down sees the plane `z`.
glm::dvec2 floor_point(const Scene& scene, glm::ivec2 pixel, double z) {
    const double half = std::tan(scene.camera->fov_y_deg * kPi / 360.0) * (scene.camera->position.z - z);
    const glm::ivec2 size = scene.settings.size;
    return {scene.camera->position.x + half * (2.0 * pixel.x + 1.0 - size.x) / size.y,
            scene.camera->position.y - half * (2.0 * pixel.y + 1.0 - size.y) / size.y};
}

// The picture's distance from what is expected of each pixel, in standard deviations.
test::PictureZ z_of(const LightPicture& picture, const std::function<double(glm::ivec2)>& expected) {
    LightPicture want{picture.size, {}};
    for (int y = 0; y < picture.size.y; ++y) {
        for (int x = 0; x < picture.size.x; ++x) {
            const double value = expected({x, y});
            want.pixels.push_back({glm::dvec3(value), glm::dvec3(std::pow(kRounding * value, 2.0))});
        }
    }
    return test::light_z(picture, want);
}

LightPicture render(const Scene& scene, std::uint32_t iterations, int block = 1) {
    const std::array blocks{block};
    return test::render_light(scene, {iterations, blocks, {}}).front();
}

double farthest_of(const test::PictureZ& z) {
    return std::max({std::abs(z.of_mean.x), std::abs(z.of_mean.y), std::abs(z.of_mean.z)});
}

// A white floor under an emitter, seen from above the emitter's side.
Scene floor_under_emitter(double radius, double height) {
    Scene scene = test::dark_scene(24, 1024, 0.1);
    test::add_box(scene, {-20, -20, -1}, {20, 20, 0}, test::add_diffuse(scene, 1.0f));
    scene.spheres.push_back({glm::dvec3(0.0, 0.0, height), radius, test::add_emitter(scene, 3.0f)});
    scene.camera = test::camera_down({8.0, 0.0, 30.0}, 8.0);
    return scene;
}

// Irradiance of a sphere wholly above the horizon: pi L sin^2 cos, with the angle under which its centre is
// seen and that of its radius. The radiance of a white floor is that over pi.
double emitter_light(double radius, double height, glm::dvec2 at) {
    const double square = glm::dot(at, at) + height * height;
    return 3.0 * radius * radius / square * height / std::sqrt(square);
}

TEST(LightForms, sphere_emitter_lights_a_floor_by_its_solid_angle) {
    for (const double radius : {0.01, 1.0, 3.999}) {
        const Scene scene = floor_under_emitter(radius, 4.0);
        const auto z = z_of(render(scene, 48), [&](glm::ivec2 pixel) {
            return emitter_light(radius, 4.0, floor_point(scene, pixel, 0.0));
        });
        EXPECT_LT(z.rms, 1.15) << radius;
        EXPECT_LT(farthest_of(z), kFarOff) << radius;
    }
}

TEST(LightForms, emitter_a_fiftieth_too_high_is_caught) {
    const Scene scene = floor_under_emitter(1.0, 4.08);
    const auto z = z_of(render(scene, 48), [&](glm::ivec2 pixel) {
        return emitter_light(1.0, 4.0, floor_point(scene, pixel, 0.0));
    });
    EXPECT_GT(farthest_of(z), 2.0 * kFarOff);
}

// Radiance of a white floor at z = 0 under a unit cube of radiance 3 with corner (0, 0, 2), by the midpoints
// of 64 x 64 parts of each face.
double cube_light(glm::dvec2 at) {
    constexpr int kParts = 64;
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        for (const int side : {0, 1}) {
            for (int i = 0; i < kParts * kParts; ++i) {
                glm::dvec3 point(0.0, 0.0, 2.0);
                point[axis] += side;
                point[(axis + 1) % 3] += (i % kParts + 0.5) / kParts;
                point[(axis + 2) % 3] += (i / kParts + 0.5) / kParts;
                const glm::dvec3 way = point - glm::dvec3(at, 0.0);
                const double square = glm::dot(way, way);
                const double emitter_cosine = (side == 1 ? -1.0 : 1.0) * way[axis] / std::sqrt(square);
                if (emitter_cosine > 0.0) sum += way.z / std::sqrt(square) * emitter_cosine / square;
            }
        }
    }
    return 3.0 / kPi * sum / (kParts * kParts);
}

TEST(LightForms, emitting_voxel_lights_a_floor_by_its_faces) {
    Scene scene = test::dark_scene(16, 1024, 0.1);
    test::add_box(scene, {-20, -20, -1}, {20, 20, 0}, test::add_diffuse(scene, 1.0f));
    test::add_box(scene, {0, 0, 2}, {1, 1, 3}, test::add_emitter(scene, 3.0f));
    scene.camera = test::camera_down({4.0, 0.5, 30.0}, 8.0);
    const LightPicture picture = render(scene, 64);
    const auto z = z_of(picture, [&](glm::ivec2 p) { return cube_light(floor_point(scene, p, 0.0)); });
    EXPECT_LT(z.rms, 1.15);
    EXPECT_LT(farthest_of(z), kFarOff);
    const auto moved = z_of(
        picture, [&](glm::ivec2 p) { return cube_light(floor_point(scene, p, 0.0) + glm::dvec2(0.3, 0.0)); });
    EXPECT_GT(farthest_of(moved), 2.0 * kFarOff) << "negative control";
}

double fresnel(double cosine, double n) {
    const double g = std::sqrt(n * n - 1.0 + cosine * cosine);
    const double across = (cosine - g) / (cosine + g), within = (n * n * cosine - g) / (n * n * cosine + g);
    return 0.5 * (across * across + within * within);
}

// A white sky in a sheet of glass on a black floor: what is seen is the reflectance. At Brewster's angle one
// polarisation is not reflected at all, and half of the other is ((n^2 - 1) / (n^2 + 1))^2 / 2.
TEST(LightForms, sky_in_glass_over_black_shows_fresnel_reflectance) {
    constexpr double kIor = 1.5;
    for (const double degrees : {0.0, 30.0, std::atan(kIor) * 180.0 / kPi, 75.0, 88.0}) {
        Scene scene = test::dark_scene(16, 1024, 0.1);
        scene.sky.radiance = glm::vec3(1.0f);
        test::add_box(scene, {-40, -40, -2}, {40, 40, -1}, test::add_diffuse(scene, 0.0f));
        test::add_box(scene, {-40, -40, -1}, {40, 40, 0}, test::add_glass(scene, kIor));
        const double angle = degrees * kPi / 180.0;
        const glm::dvec3 away(0.0, -std::sin(angle), std::cos(angle));
        scene.camera = test::camera_towards(30.0 * away, glm::dvec3(0.0), 0.2);
        const double expected = fresnel(std::cos(angle), kIor);
        if (degrees > 50.0 && degrees < 60.0) {
            EXPECT_NEAR(expected, 0.5 * std::pow((kIor * kIor - 1.0) / (kIor * kIor + 1.0), 2.0), 1e-12);
        }
        const LightPicture picture = render(scene, 64, 16);
        const TruthPixel& pixel = picture.pixels.front();
        EXPECT_LT(std::abs(pixel.mean.x - expected), kFarOff * std::sqrt(pixel.variance_of_mean.x))
            << degrees;
        EXPECT_LT(std::sqrt(pixel.variance_of_mean.x), 0.01) << degrees;
    }
}

// A slab moves what is behind it across the ray by T sin a (1 - cos a / sqrt(n^2 - sin^2 a)).
TEST(LightForms, slab_of_glass_moves_an_edge_by_snells_law) {
    constexpr double kThickness = 4.0, kAngle = kPi / 4.0;
    const auto edge_column = [&](float ior) {
        Scene scene = test::dark_scene(256, 1024, 0.1);
        scene.settings.size = {256, 4};
        const std::uint16_t emitter = test::add_emitter(scene, 1.0f);
        test::add_box(scene, {-60, 50, -4}, {0, 51, 4}, emitter);
        if (ior > 1.0f) test::add_box(scene, {-120, 10, -4}, {60, 14, 4}, test::add_glass(scene, ior));
        // Rays come at 45 degrees from far away, almost parallel, and meet the edge (0, 50, 0) without glass.
        const glm::dvec3 back = glm::dvec3(-std::sin(kAngle), -std::cos(kAngle), 0.0);
        const glm::dvec3 eye = glm::dvec3(0.0, 50.0, 0.0) + 400.0 * back;
        scene.camera = test::camera_towards(eye, {0.0, 50.0, 0.0}, 0.015);
        const LightPicture picture = render(scene, 16, 4);
        double bright = 0.0, sum = 0.0;  // area of the edge, in blocks
        for (const TruthPixel& pixel : picture.pixels)
            bright = std::max(bright, pixel.mean.x);
        for (const TruthPixel& pixel : picture.pixels)
            sum += pixel.mean.x > 0.5 * bright ? 1.0 : 0.0;
        const double width = 2.0 * 400.0 * std::tan(0.015 * kPi / 360.0) * 64.0;  // of the picture, voxels
        return sum / static_cast<double>(picture.pixels.size()) * width;
    };
    const double bare = edge_column(1.0f);
    for (const float ior : {1.5f, 1.7f}) {
        const double n = ior, sine = std::sin(kAngle);
        const double expected = kThickness * sine * (1.0 - std::cos(kAngle) / std::sqrt(n * n - sine * sine));
        EXPECT_NEAR(std::abs(edge_column(ior) - bare), expected, 0.15) << ior;
    }
}

// A ball of glass under a sun straight above, seen from below the ball. What passes through it with the ray
// height b arrives `landing` from the axis, on a floor `distance` below the centre: two refractions turn it
// by 2 (i - r). Near the axis all rays meet at the distance n R / (2 (n - 1)).
struct Ball {
    double radius = 8.0;
    double n = 1.5;

    [[nodiscard]] double landing(double b, double distance) const {
        const double i = std::asin(b / radius), r = std::asin(b / (n * radius));
        const double leaves = 2.0 * r - i;  // angle of the exit point from the downward axis
        const glm::dvec2 exit(radius * std::sin(leaves), radius * std::cos(leaves));
        return exit.x - std::tan(2.0 * (i - r)) * (distance - exit.y);
    }
    // Mean irradiance within `spot` of the axis, the sun's being 1; without light reflected inside the ball.
    [[nodiscard]] double mean_within(double spot, double distance) const {
        constexpr int kSteps = 20000;
        double power = 0.0;
        for (int k = 0; k < kSteps; ++k) {
            const double b = radius * (k + 0.5) / kSteps;
            if (std::abs(landing(b, distance)) > spot) continue;
            const double passes = 1.0 - fresnel(std::sqrt(1.0 - b * b / (radius * radius)), n);
            power += passes * passes * 2.0 * kPi * b * radius / kSteps;
        }
        return power / (kPi * spot * spot);
    }
};

// Mean irradiance of the floor within `spot` of the axis.
TruthPixel caustic_of(float ior, double distance, double spot) {
    Scene scene = test::dark_scene(64, 65536, 0.05);
    const int floor = -static_cast<int>(distance);
    test::add_box(scene, {-9, -9, floor - 1}, {9, 9, floor}, test::add_diffuse(scene, 1.0f));
    scene.spheres.push_back({glm::dvec3(0.0), 8.0, test::add_glass(scene, ior)});
    scene.sun = {.elevation_deg = 90.0f, .angular_diameter_deg = 0.0f, .irradiance = glm::vec3(1.0f)};
    scene.camera = test::camera_down({0.0, 0.0, floor + 2.0}, 112.6);  // 6 voxels of floor
    const LightPicture picture = render(scene, 24);
    TruthPixel sum{glm::dvec3(0.0), glm::dvec3(0.0)};
    double count = 0.0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const glm::dvec2 at = floor_point(scene, {x, y}, floor);
            if (glm::length(at) > spot) continue;
            sum.mean += kPi * picture.at({x, y}).mean;
            count += 1.0;
        }
    }
    sum.mean /= count;
    return sum;
}

TEST(LightFormsNightly, ball_of_glass_gathers_the_sun_at_its_focus) {
    const Ball ball;
    EXPECT_NEAR(ball.landing(0.05, ball.n * ball.radius / (2.0 * (ball.n - 1.0))), 0.0, 1e-5);
    // Relative: 24 iterations with some hundred photons in the spot, and what is reflected inside the ball.
    constexpr double kTolerance = 0.03;
    for (const double distance : {11.0, 12.0, 14.0}) {
        for (const double spot : {1.0, 2.0}) {
            const double expected = ball.mean_within(spot, distance);
            EXPECT_NEAR(caustic_of(1.5f, distance, spot).mean.x / expected, 1.0, kTolerance)
                << distance << ' ' << spot;
        }
    }
    EXPECT_GT(std::abs(caustic_of(1.55f, 14.0, 1.0).mean.x / ball.mean_within(1.0, 14.0) - 1.0),
              2.0 * kTolerance)
        << "negative control";
}

// A closed white room one wall of which is black and of radiance 1 is full of radiance 1: a furnace.
Scene furnace(std::uint16_t (*add_wall)(Scene&, float), const glm::ivec3& room, int emitter_width) {
    Scene scene = test::dark_scene(16, 16384, 0.05);
    test::add_room(scene, room, add_wall(scene, 1.0f));
    test::add_box(scene, {0, room.y, 0}, {emitter_width, room.y + 1, emitter_width},
                  test::add_emitter(scene, 1.0f));
    scene.camera = test::camera_towards({0.5 * room.x, 0.25 * room.y, 0.5 * room.z},
                                        {0.9 * room.x, 0.5 * room.y, 0.1 * room.z}, 70.0);
    return scene;
}

// Standard deviations of a root mean square over blocks that have photons in common: it scatters hardly less
// than a single number.
constexpr double kMaxOfFew = 2.5;

void expect_furnace(const Scene& scene, std::uint32_t iterations, double radiance, const char* what) {
    const std::array blocks{4, 16};
    const auto pictures = test::render_light(scene, {iterations, blocks, {}});
    const auto z = z_of(pictures[0], [&](glm::ivec2) { return radiance; });
    const auto whole = z_of(pictures[1], [&](glm::ivec2) { return radiance; });
    EXPECT_LT(z.rms, kMaxOfFew) << what;
    EXPECT_LT(farthest_of(whole), kFarOff) << what;
    EXPECT_LT(std::sqrt(pictures[1].pixels[0].variance_of_mean.x), 0.02 * radiance) << what;
}

TEST(LightFormsNightly, white_furnace_of_diffuse_walls) {
    expect_furnace(furnace(test::add_diffuse, {8, 8, 8}, 8), 64, 1.0, "a wall");
    // A path meets 37 walls on average, the longest over 500.
    expect_furnace(furnace(test::add_diffuse, {5, 5, 5}, 2), 96, 1.0, "4 voxels of 150");
}

TEST(LightForms, white_furnace_of_mirror_walls) {
    Scene scene = furnace(test::add_mirror, {8, 8, 8}, 8);
    scene.camera->fov_y_deg =
        30.0;  // no ray is nearly parallel to the emitter, which many mirrors would meet
    expect_furnace(scene, 16, 1.0, "mirrors");
}

TEST(LightForms, white_furnace_with_glass_and_mirrors_inside) {
    Scene scene = furnace(test::add_diffuse, {8, 8, 8}, 8);
    test::add_box(scene, {5, 2, 0}, {7, 5, 3}, test::add_glass(scene, 1.5f));
    test::add_box(scene, {2, 3, 0}, {3, 4, 3}, test::add_mirror(scene));
    scene.spheres.push_back({glm::dvec3(5.6, 4.4, 3.8), 1.2, test::add_glass(scene, 1.7f)});
    scene.spheres.push_back({glm::dvec3(7.0, 5.5, 6.0), 0.7, test::add_mirror(scene)});
    expect_furnace(scene, 96, 1.0, "glass");
}

// In glass of index n all radiance is n^2 times as much.
TEST(LightFormsNightly, white_furnace_seen_from_inside_glass_is_n_squared_times_as_bright) {
    Scene ball = furnace(test::add_diffuse, {8, 8, 8}, 8);
    ball.spheres.push_back({glm::dvec3(4.0, 2.0, 4.0), 1.5, test::add_glass(ball, 1.5f)});
    expect_furnace(ball, 96, 2.25, "ball");
    Scene block = furnace(test::add_diffuse, {8, 8, 8}, 8);
    test::add_box(block, {3, 1, 3}, {5, 3, 5}, test::add_glass(block, 1.5f));
    // Straight ahead: rays that are oblique to all three axes never leave a cube of glass.
    block.camera = test::camera_towards({4.1, 2.2, 3.9}, {4.1, 8.0, 3.9}, 30.0);
    expect_furnace(block, 96, 2.25, "voxels");
}

TEST(LightForms, furnace_that_loses_a_fiftieth_is_caught) {
    Scene scene = furnace(test::add_diffuse, {8, 8, 8}, 8);
    scene.materials[0].albedo = glm::vec3(0.98f);
    const std::array blocks{16};
    const auto picture = test::render_light(scene, {64, blocks, {}}).front();
    EXPECT_GT(farthest_of(z_of(picture, [](glm::ivec2) { return 1.0; })), kFarOff);
}

// Where all walls glow with radiance L and have the albedo a, there is L / (1 - a) everywhere.
TEST(LightForms, room_whose_voxels_all_emit_is_evenly_bright) {
    Scene scene = test::dark_scene(16, 16384, 0.05);
    test::add_room(scene, {6, 6, 6}, test::add_emitter(scene, 1.0f, 0.5f));
    scene.camera = test::camera_towards({3.0, 1.0, 3.0}, {3.2, 6.0, 2.0}, 70.0);
    expect_furnace(scene, 64, 2.0, "all emit");
}

// An emitter of radius r in a hollow ball of radius R and albedo a: see path_truth_test.
Scene hollow_ball(double wall_radius, glm::vec3 albedo) {
    Scene scene = test::dark_scene(16, 16384, 0.02 * wall_radius);
    const std::uint16_t wall = test::add_material(scene, {.name = "wall", .albedo = albedo});
    scene.spheres.push_back({glm::dvec3(0.0), wall_radius, wall});
    scene.spheres.push_back({glm::dvec3(0.0), 0.25 * wall_radius, test::add_emitter(scene, 8.0f)});
    scene.camera = test::camera_towards({0.0, -0.5 * wall_radius, 0.0}, {0.0, -wall_radius, 0.0}, 40.0);
    return scene;
}
constexpr double kEmitterPart = 0.25 * 0.25;

TEST(LightFormsNightly, emitter_in_a_hollow_ball_of_any_size_gives_the_series_of_reflections) {
    for (const double radius : {4.0, 1e3, 1e4, 1e5, 1e6}) {
        const Scene scene = hollow_ball(radius, {0.25f, 0.5f, 0.75f});
        const TruthPixel pixel = render(scene, 64, 16).pixels.front();
        for (int c = 0; c < 3; ++c) {
            const double a = 0.25 * (c + 1);
            const double expected = a * 8.0 * kEmitterPart / (1.0 - a * (1.0 - kEmitterPart));
            EXPECT_LT(std::abs(pixel.mean[c] - expected), kFarOff * std::sqrt(pixel.variance_of_mean[c]))
                << radius << ' ' << c;
            EXPECT_LT(std::sqrt(pixel.variance_of_mean[c]), 0.01 * expected) << radius;
        }
    }
}

// A photon is stored where it arrives after the first wall, again and again with probability a (1 - F), until
// roulette takes it or the black emitter, which keeps none because it sends none on.
TEST(LightForms, stored_photons_are_a_geometric_series_of_those_emitted) {
    for (const float albedo : {0.5f, 0.9f}) {
        constexpr double kPhotons = 16384.0 * 16.0;
        Scene scene = hollow_ball(4.0, glm::vec3(albedo));
        scene.settings.photons.radius = 16.0;  // so that visible points accept all of them
        test::FrameFixture fixture(scene, PlanRequest{});
        double stored = 0.0;
        for (std::uint32_t i = 0; i < 16; ++i)
            stored += fixture.render(i).counters[gpu::kWorkPhotonsStored];
        const double q = albedo * (1.0 - kEmitterPart);
        const double mean = q / (1.0 - q);  // of one photon
        const double variance = mean / (1.0 - q);
        EXPECT_LT(std::abs(stored - kPhotons * mean), kFarOff * std::sqrt(kPhotons * variance)) << albedo;
    }
}

}  // namespace
}  // namespace voxilux
