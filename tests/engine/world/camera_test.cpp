// camera.h against long double: where rays start, where they point, and where they enter the world.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <optional>

#include "support/march_oracle.h"
#include "support/ray_families.h"
#include "support/statistics.h"
#include "world/march_world.h"
// After the world's, which says how C++ reads it.
#include "shared/camera.h"

namespace voxilux {
namespace {

// Voxels. The header promises 2^-24 a million voxels away and 2^-21 for the farthest camera, 2^23 voxels
// away; the rounding of the fraction, 2^-25, is added.
constexpr long double kEntryError = 0x1p-20L;
// The length of a float direction after one division by a rounded root.
constexpr double kLengthError = 2e-7;
// Components of a direction, in units of its length: three products, two sums and the division.
constexpr double kDirectionError = 4e-7;

constexpr glm::ivec3 kSize(48, 32, 16);

std::string print(const gpu::Ray& ray) {
    return fmt::format("cell ({}, {}, {}) fraction ({}, {}, {}) direction ({}, {}, {})", ray.cell.x,
                       ray.cell.y, ray.cell.z, ray.fraction.x, ray.fraction.y, ray.fraction.z,
                       ray.direction.x, ray.direction.y, ray.direction.z);
}

using Long3 = std::array<long double, 3>;

struct TrueEntry {
    long double t = 0.0L;
    long double slack = 0.0L;  // how long the ray stays in the world, negative for a miss
    Long3 position{};
};

TrueEntry true_entry(const gpu::Ray& ray, glm::ivec3 size) {
    TrueEntry entry;
    long double leave = INFINITY;
    Long3 origin{};
    for (int a = 0; a < 3; ++a) {
        const auto axis = static_cast<std::size_t>(a);
        origin[axis] = static_cast<long double>(ray.cell[a]) + static_cast<long double>(ray.fraction[a]);
        const auto d = static_cast<long double>(ray.direction[a]);
        const auto top = static_cast<long double>(size[a]);
        if (std::abs(ray.direction[a]) < gpu::kMinDirection) {
            if (ray.cell[a] < 0 || ray.cell[a] >= size[a]) leave = -INFINITY;
            continue;
        }
        entry.t = std::max(entry.t, ((d > 0 ? 0.0L : top) - origin[axis]) / d);
        leave = std::min(leave, ((d > 0 ? top : 0.0L) - origin[axis]) / d);
    }
    entry.slack = leave - entry.t;
    for (std::size_t a = 0; a < 3; ++a)
        entry.position[a] =
            origin[a] + entry.t * static_cast<long double>(ray.direction[static_cast<int>(a)]);
    return entry;
}

long double position_error(const gpu::Ray& ray, const Long3& truth) {
    long double worst = 0.0L;
    for (int a = 0; a < 3; ++a) {
        const long double p =
            static_cast<long double>(ray.cell[a]) + static_cast<long double>(ray.fraction[a]);
        worst = std::max(worst, std::abs(p - truth[static_cast<std::size_t>(a)]));
    }
    return worst;
}

void expect_true_entry(const gpu::Ray& ray) {
    const gpu::WorldEntry entry = gpu::enter_world(ray, kSize);
    const TrueEntry truth = true_entry(ray, kSize);
    // A ray that only touches the border may count as a hit or a miss.
    if (std::abs(truth.slack) > 4.0L * kEntryError) {
        ASSERT_EQ(entry.enters, truth.slack > 0.0L) << print(ray);
    }
    if (!entry.enters) return;
    ASSERT_FALSE(gpu::is_outside(entry.ray.cell, kSize)) << print(ray);
    ASSERT_LT(position_error(entry.ray, truth.position), kEntryError) << print(ray);
    ASSERT_NEAR(static_cast<double>(entry.t), static_cast<double>(truth.t),
                1e-7 * static_cast<double>(truth.t) + 1e-6);
    ASSERT_EQ(entry.ray.direction, ray.direction);
}

glm::dvec3 random_unit(test::TestRandom& random) {
    for (;;) {
        const glm::dvec3 v(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        if (glm::length(v) > 0.1 && glm::length(v) < 1.0) return glm::normalize(v);
    }
}

// A ray from `distance` away towards a point of the world or just beside it.
gpu::Ray ray_from_afar(test::TestRandom& random, double distance) {
    const glm::dvec3 target =
        glm::dvec3(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)) +
        glm::dvec3(kSize) * glm::dvec3(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
    const glm::dvec3 origin = target - random_unit(random) * distance;
    const glm::dvec3 cell = glm::floor(origin);
    return {glm::ivec3(cell), glm::vec3(origin - cell), glm::vec3(glm::normalize(target - origin)),
            gpu::kUnbounded};
}

TEST(EnterWorld, cameras_one_to_eight_million_voxels_away_enter_where_long_double_does) {
    test::TestRandom random(31);
    for (double distance = 1.0; distance <= 8388000.0; distance *= 1.5) {
        for (int i = 0; i < 1500; ++i) {
            expect_true_entry(ray_from_afar(random, distance));
            if (HasFatalFailure()) return;
        }
    }
}

// Starts on lattice planes, also of the border itself, with directions of small integers: ties of every kind.
TEST(EnterWorld, starts_on_lattice_planes_around_the_border_enter_where_long_double_does) {
    test::TestRandom random(32);
    const auto integer = [&](int low, int high) {
        return low + static_cast<int>(random.bits32() % static_cast<std::uint32_t>(high - low + 1));
    };
    for (int i = 0; i < 100000; ++i) {
        gpu::Ray ray{.t_max = gpu::kUnbounded};
        for (int a = 0; a < 3; ++a) {
            const std::array<int, 6> cells = {
                -1, 0, kSize[a] - 1, kSize[a], integer(-3, -1), integer(0, kSize[a])};
            ray.cell[a] = cells[random.bits32() % cells.size()];
            ray.fraction[a] = static_cast<float>(integer(0, 2)) * 0.5f;
            ray.direction[a] = static_cast<float>(integer(-2, 2));
        }
        if (ray.direction == glm::vec3(0.0f)) continue;
        expect_true_entry(ray);
        if (HasFatalFailure()) return;
    }
}

TEST(EnterWorld, ray_that_starts_inside_is_unchanged) {
    const gpu::Ray ray{{47, 0, 15}, {1.0f, 0.0f, 0.5f}, {0.6f, -0.8f, 0.0f}, 5.0f};
    const gpu::WorldEntry entry = gpu::enter_world(ray, kSize);
    EXPECT_TRUE(entry.enters);
    EXPECT_EQ(entry.t, 0.0f);
    EXPECT_EQ(entry.ray.cell, ray.cell);
    EXPECT_EQ(entry.ray.fraction, ray.fraction);
    EXPECT_EQ(entry.ray.t_max, 5.0f);
}

TEST(EnterWorld, interval_that_ends_before_the_border_misses_and_a_longer_one_keeps_its_rest) {
    gpu::Ray ray{{-8, 4, 4}, glm::vec3(0.5f), {1, 0, 0}, 7.5f};
    EXPECT_FALSE(gpu::enter_world(ray, kSize).enters);
    ray.t_max = 9.0f;
    const gpu::WorldEntry entry = gpu::enter_world(ray, kSize);
    EXPECT_TRUE(entry.enters);
    EXPECT_EQ(entry.t, 7.5f);
    EXPECT_EQ(entry.ray.t_max, 1.5f);
    EXPECT_EQ(entry.ray.cell, glm::ivec3(0, 4, 4));
    EXPECT_EQ(entry.ray.fraction, glm::vec3(0.0f, 0.5f, 0.5f));
}

// Far cells with directions that would reach the world only beyond every float integer, and bad ones.
TEST(EnterWorld, hopeless_rays_miss_without_overflow) {
    const float inf = std::numeric_limits<float>::infinity();
    for (const int far : {-8388607, 8388607}) {
        for (const glm::vec3 direction :
             {glm::vec3(1e-9f, 1, 0), glm::vec3(-1e-9f, 0.7f, 0.7f), glm::vec3(1e-18f, 1, 0),
              glm::vec3(1e-5f, 1, 0), glm::vec3(1e-4f, 0.7f, -0.7f), glm::vec3(1, 1e-9f, 1e-30f),
              glm::vec3(-0.0f, 0.0f, 1), glm::vec3(1, 1, 1)}) {
            for (const float sign : {1.0f, -1.0f}) {
                const gpu::Ray ray{{far, 7, 9}, glm::vec3(0.5f), sign * direction, gpu::kUnbounded};
                const TrueEntry truth = true_entry(ray, kSize);
                EXPECT_EQ(gpu::enter_world(ray, kSize).enters, truth.slack > 0.0L) << print(ray);
            }
        }
        const gpu::Ray bad{{far, 7, 9}, glm::vec3(0.5f), glm::vec3(inf, 1, 0), gpu::kUnbounded};
        EXPECT_EQ(gpu::enter_world(bad, kSize).t, 0.0f) << "left to the march, which counts it";
    }
}

TEST(EnterWorld, oracle_rejects_an_entry_moved_by_a_millionth_of_a_voxel) {
    test::TestRandom random(33);
    int caught = 0;
    int entered = 0;
    for (int i = 0; i < 1000; ++i) {
        const gpu::Ray ray = ray_from_afar(random, 1e6);
        gpu::WorldEntry entry = gpu::enter_world(ray, kSize);
        if (!entry.enters) continue;
        ++entered;
        entry.ray.fraction += glm::vec3(2e-6f);
        caught += position_error(entry.ray, true_entry(ray, kSize).position) >= kEntryError ? 1 : 0;
    }
    EXPECT_GT(entered, 500);
    EXPECT_EQ(caught, entered);
}

gpu::FrameParams random_frame(test::TestRandom& random) {
    gpu::FrameParams frame{};
    frame.camera_cell = {3, -4, 5};
    frame.camera_fraction = {0.25f, 0.5f, 0.75f};
    const glm::dvec3 forward = random_unit(random);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, random_unit(random)));
    const double half_height = std::exp(random.uniform(-8.0, 2.0));
    frame.camera_forward = glm::vec3(forward);
    frame.camera_right = glm::vec3(right * half_height * 1.5);
    frame.camera_up = glm::vec3(glm::cross(right, forward) * half_height);
    frame.width = 96;
    frame.height = 64;
    frame.sample_index = random.bits32();
    frame.seed = random.bits32();
    return frame;
}

// Coordinates on the image plane of a direction, in pixels, by the frame's own axes in double.
glm::dvec2 pixel_of(const gpu::FrameParams& frame, glm::dvec3 direction) {
    const glm::dvec3 forward(frame.camera_forward);
    const glm::dvec3 right(frame.camera_right);
    const glm::dvec3 up(frame.camera_up);
    const glm::dvec3 on_plane = direction / glm::dot(direction, forward);
    return {(glm::dot(on_plane, right) / glm::dot(right, right) + 1.0) * 0.5 * frame.width,
            (1.0 - glm::dot(on_plane, up) / glm::dot(up, up)) * 0.5 * frame.height};
}

TEST(CameraRay, is_unit_starts_at_the_camera_and_passes_through_its_pixel) {
    test::TestRandom random(34);
    for (int i = 0; i < 20000; ++i) {
        const gpu::FrameParams frame = random_frame(random);
        const gpu::uint x = random.bits32() % frame.width;
        const gpu::uint y = random.bits32() % frame.height;
        const gpu::Ray ray = gpu::camera_ray(frame, gpu::kPerspective, random.bits32() % 3, x, y);
        ASSERT_EQ(ray.cell, frame.camera_cell);
        ASSERT_EQ(ray.fraction, frame.camera_fraction);
        ASSERT_NEAR(glm::length(glm::dvec3(ray.direction)), 1.0, kLengthError);
        const double half_height = glm::length(glm::dvec3(frame.camera_up));
        // Pixels. A direction error of kDirectionError moves the point by that over the size of half a
        // picture.
        const double blur =
            kDirectionError * (1.0 + half_height * half_height * 4.0) / half_height * frame.width;
        const glm::dvec2 at = pixel_of(frame, glm::dvec3(ray.direction)) - glm::dvec2(x, y);
        ASSERT_GT(std::min(at.x, at.y), -blur) << i;
        ASSERT_LT(std::max(at.x, at.y), 1.0 + blur) << i;
    }
}

// Unit axes that look along +x with z up.
gpu::FrameParams panorama_frame() {
    gpu::FrameParams frame{};
    frame.camera_forward = {1, 0, 0};
    frame.camera_right = {0, -1, 0};
    frame.camera_up = {0, 0, 1};
    frame.camera_angle = 1.5f;
    frame.width = 64;
    frame.height = 32;
    return frame;
}

TEST(Panorama, equirectangular_pixels_have_the_azimuth_and_elevation_of_the_contract) {
    const gpu::FrameParams frame = panorama_frame();
    constexpr double kPi = std::numbers::pi;
    for (int j = 0; j < 32; ++j) {
        for (int i = 0; i < 64; ++i) {
            const double azimuth = kPi - 2.0 * kPi * (i + 0.5) / 64.0;
            const double elevation = kPi / 2.0 - kPi * (j + 0.5) / 32.0;
            const glm::dvec3 want(std::cos(elevation) * std::cos(azimuth),
                                  std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
            const glm::dvec3 got(gpu::panorama_direction(
                frame, gpu::kEquirectangular, static_cast<float>(i) + 0.5f, static_cast<float>(j) + 0.5f));
            ASSERT_LT(glm::length(got - want), kDirectionError) << i << " " << j;
        }
    }
}

TEST(Panorama, fisheye_angle_grows_in_proportion_to_the_distance_from_the_middle) {
    const gpu::FrameParams frame = panorama_frame();
    for (int j = 0; j <= 32; ++j) {
        for (int i = 0; i <= 64; ++i) {
            const glm::dvec2 from_middle((i - 32) / 16.0, (16 - j) / 16.0);
            const double angle = std::min(1.5 * glm::length(from_middle), std::numbers::pi);
            const glm::dvec3 got(
                gpu::panorama_direction(frame, gpu::kFisheye, static_cast<float>(i), static_cast<float>(j)));
            ASSERT_NEAR(std::atan2(std::hypot(got.y, got.z), got.x), angle, 1e-5) << i << " " << j;
            // To the side of the image that the point is on: y is to the left.
            ASSERT_GE(-got.y * from_middle.x + got.z * from_middle.y, -1e-6) << i << " " << j;
        }
    }
}

gpu::FrameParams parallel_frame(test::TestRandom& random, gpu::uint block, bool is_aligned) {
    gpu::FrameParams frame{};
    frame.camera_cell = {static_cast<int>(random.bits32() % 200) - 100,
                         static_cast<int>(random.bits32() % 200) - 100,
                         static_cast<int>(random.bits32() % 200) - 100};
    frame.camera_block = block;
    frame.camera_pixel = {random.bits32() % block, random.bits32() % block};
    frame.width = 4096;
    frame.height = 4096;
    frame.seed = random.bits32();
    const glm::dvec3 forward = is_aligned ? glm::dvec3(0, 1, 0) : random_unit(random);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 0, 1)));
    frame.camera_forward = glm::vec3(forward);
    frame.camera_right = glm::vec3(right);
    frame.camera_up = glm::vec3(glm::cross(right, forward));
    if (!is_aligned) frame.camera_fraction = {0.25f, 0.5f, 0.75f};
    return frame;
}

// Two products and two sums of 48 bits, then one rounding of the fraction.
constexpr double kStartError = 0x1p-23;

TEST(ParallelRay, starts_where_its_pixel_is_and_points_forward) {
    test::TestRandom random(36);
    for (int i = 0; i < 20000; ++i) {
        const gpu::uint block = 1 + random.bits32() % 9;
        const gpu::FrameParams frame = parallel_frame(random, block, i % 2 == 0);
        const gpu::uint x = random.bits32() % frame.width, y = random.bits32() % frame.height;
        const gpu::Ray ray = gpu::orthographic_ray(frame, x, y, {0.375f, 0.875f});
        const double across = (x + frame.camera_pixel.x + 0.375) / block;
        const double down = (y + frame.camera_pixel.y + 0.875) / block;
        const glm::dvec3 want = glm::dvec3(frame.camera_cell) + glm::dvec3(frame.camera_fraction) +
                                across * glm::dvec3(frame.camera_right) - down * glm::dvec3(frame.camera_up);
        const glm::dvec3 got = glm::dvec3(ray.cell) + glm::dvec3(ray.fraction);
        // The part of a block is one rounded quotient, 2^-24 of it.
        ASSERT_LT(glm::length(got - want), 3.0 * kStartError) << i;
        ASSERT_EQ(ray.direction, frame.camera_forward);
    }
}

// The ends of the pixel, which samples may be rounded to, included.
TEST(ParallelRay, starts_in_the_cell_of_its_block_wherever_in_the_pixel_its_sample_is) {
    test::TestRandom random(37);
    for (int i = 0; i < 20000; ++i) {
        const gpu::uint block = 1 + random.bits32() % 9;
        const gpu::FrameParams frame = parallel_frame(random, block, true);
        const gpu::uint x = random.bits32() % frame.width, y = random.bits32() % frame.height;
        for (const float end : {0.0f, 0x1p-24f, 0.5f, 1.0f - 0x1p-24f, 1.0f}) {
            const gpu::Ray ray = gpu::orthographic_ray(frame, x, y, {end, 1.0f - end});
            ASSERT_EQ(ray.cell.x, frame.camera_cell.x + static_cast<int>((x + frame.camera_pixel.x) / block));
            ASSERT_EQ(ray.cell.z,
                      frame.camera_cell.z - 1 - static_cast<int>((y + frame.camera_pixel.y) / block));
        }
    }
}

TEST(CameraRay, samples_fill_the_pixel_evenly_in_every_sequence) {
    test::TestRandom random(35);
    for (const gpu::uint sequence : {gpu::kSequenceSobol, gpu::kSequenceHalton, gpu::kSequenceWhite}) {
        gpu::FrameParams frame = random_frame(random);
        constexpr int kSamples = 4096;
        glm::dvec2 mean(0.0);
        for (frame.sample_index = 0; frame.sample_index < kSamples; ++frame.sample_index)
            mean +=
                pixel_of(frame,
                         glm::dvec3(gpu::camera_ray(frame, gpu::kPerspective, sequence, 17, 5).direction)) -
                glm::dvec2(17, 5);
        mean /= kSamples;
        // Five standard deviations of the mean of uniform numbers, white noise being the worst.
        const double bound = 5.0 * std::sqrt(1.0 / 12.0 / kSamples);
        EXPECT_NEAR(mean.x, 0.5, bound) << sequence;
        EXPECT_NEAR(mean.y, 0.5, bound) << sequence;
    }
}

// Squared distance from the middle, and the mean, of points of the aperture.
struct Spread {
    double square = 0.0;
    glm::dvec2 mean{0.0};
    double longest = 0.0;
};

Spread spread_of(gpu::uint blades) {
    constexpr int kSide = 512;
    Spread spread;
    for (int i = 0; i < kSide * kSide; ++i) {
        const glm::vec2 u = (glm::vec2(i % kSide, i / kSide) + 0.5f) / static_cast<float>(kSide);
        const glm::dvec2 point(gpu::aperture_point(blades, u));
        spread.square += glm::dot(point, point) / (kSide * kSide);
        spread.mean += point / static_cast<double>(kSide * kSide);
        spread.longest = std::max(spread.longest, glm::length(point));
    }
    return spread;
}

// The mean square is 1/2 for a disc; for a regular polygon of n corners, (2 + cos(2 pi / n)) / 6.
TEST(Lens, points_fill_the_aperture_evenly) {
    constexpr double kGridError = 1e-4;  // of a midpoint rule of 512 x 512 points: 1 / 512^2, and kinks
    for (const gpu::uint blades : {0u, 1u, 2u, 3u, 4u, 6u, 64u}) {
        const double corner = std::cos(2.0 * std::numbers::pi / blades);
        const double square = blades < 3 ? 0.5 : (2.0 + corner) / 6.0;
        const Spread spread = spread_of(blades);
        EXPECT_NEAR(spread.square, square, kGridError) << blades;
        EXPECT_LT(glm::length(spread.mean), kGridError) << blades;
        EXPECT_LE(spread.longest, 1.0 + 1e-6) << blades;
        EXPECT_GT(spread.longest, 0.99) << blades;
    }
}

// Where the ray is at a depth along the view axis, from the camera's cell.
glm::dvec3 at_depth(const gpu::FrameParams& frame, const gpu::Ray& ray, double depth) {
    const glm::dvec3 start = glm::dvec3(ray.cell - frame.camera_cell) + glm::dvec3(ray.fraction);
    const glm::dvec3 direction(ray.direction);
    return start + direction * (depth / glm::dot(direction, glm::dvec3(frame.camera_forward)));
}

TEST(Lens, rays_of_a_pixel_meet_in_the_plane_of_focus_and_part_beyond_it) {
    test::TestRandom random(36);
    for (int i = 0; i < 5000; ++i) {
        gpu::FrameParams frame = random_frame(random);
        const double focus = 40.0, radius = 3.0;
        frame.lens_radius = static_cast<float>(radius);
        frame.lens_power = static_cast<float>(1.0 / focus);
        const gpu::uint x = random.bits32() % frame.width, y = random.bits32() % frame.height;
        const gpu::uint sequence = random.bits32() % 3;
        const gpu::Ray sharp = gpu::camera_ray(frame, gpu::kPerspective, sequence, x, y);
        const gpu::Ray ray = gpu::camera_ray(frame, gpu::kThinLens, sequence, x, y);
        ASSERT_NEAR(glm::length(glm::dvec3(ray.direction)), 1.0, kLengthError);
        ASSERT_TRUE(gpu::is_sound(ray)) << i;
        // Both directions are off by kDirectionError. Projected along a ray, that grows by 1 / cosine twice.
        const double cosine = glm::dot(glm::dvec3(ray.direction), glm::dvec3(frame.camera_forward));
        ASSERT_LT(glm::distance(at_depth(frame, ray, focus), at_depth(frame, sharp, focus)),
                  2.0 * kDirectionError * focus / (cosine * cosine))
            << i;
        for (const double depth : {0.0, 20.0, 160.0}) {
            const double blur = glm::distance(at_depth(frame, ray, depth), at_depth(frame, sharp, depth));
            ASSERT_LE(blur, radius * std::abs(1.0 - depth / focus) + 1e-3) << i;
        }
    }
}

TEST(Lens, of_no_width_or_focused_at_infinity) {
    test::TestRandom random(37);
    gpu::FrameParams frame = random_frame(random);
    frame.lens_power = 0.125f;
    const gpu::Ray pinhole = gpu::camera_ray(frame, gpu::kPerspective, gpu::kSequenceWhite, 9, 5);
    EXPECT_EQ(print(gpu::camera_ray(frame, gpu::kThinLens, gpu::kSequenceWhite, 9, 5)), print(pinhole));
    frame.lens_radius = 2.0f;
    frame.lens_power = 0.0f;
    const gpu::Ray ray = gpu::camera_ray(frame, gpu::kThinLens, gpu::kSequenceWhite, 9, 5);
    EXPECT_EQ(ray.direction, pinhole.direction);
    EXPECT_NE(print(ray), print(pinhole));
}

}  // namespace
}  // namespace voxilux
