// The pass ao.trace by brute force over many rays against closed forms (support/occlusion_forms.h). Blocked
// rays are counted exactly, so with white noise the counts are binomial.

#include <gtest/gtest.h>

#include <functional>

#include "support/frame_fixture.h"
#include "support/occlusion_forms.h"
#include "support/test_scenes.h"

namespace voxilux {
namespace {

// Standard deviations. All counts of a picture together may stray by this much (1 in 16,000), and one pixel
// of a thousand by more. The seeds are fixed, so what passes once stays so.
constexpr double kWholeSigmas = 4.0;
constexpr double kPixelSigmas = 5.0;
// Below this variance of a count the binomial is not normal enough for a test of one pixel.
constexpr double kNormalVariance = 9.0;

constexpr float kRadius = 16.0f;
constexpr std::uint32_t kRays = 1024;

// A floor of top z = 0 in a square that no ray of kRadius leaves when it starts within 8 voxels of the
// middle.
Scene floor_scene() {
    Scene scene = test::white_scene();
    test::add_box(scene, {-26, -26, -1}, {26, 26, 0});
    scene.settings.size = {20, 20};
    scene.settings.ao_rays = kRays;
    scene.settings.ao_radius = kRadius;
    scene.settings.sequence = Sequence::white;
    return scene;
}

struct Stray {
    double whole = 0.0;  // of all counts together, in standard deviations
    double worst_pixel = 0.0;
    int pixels = 0;  // compared
};

// `blocked` gives the blocked fraction for a hit at a scene position on a face; negative leaves the pixel
// out.
using Expected = std::function<double(glm::dvec3 position, gpu::uint face)>;

Stray compare(const Scene& scene, const Expected& blocked) {
    test::FrameFixture fixture(scene);
    const test::FramePlanes planes = fixture.render(0);
    const double rays = scene.settings.ao_rays;
    Stray stray;
    double difference = 0.0;
    double variance = 0.0;
    for (std::size_t i = 0; i < planes.hits.size(); ++i) {
        const gpu::Hit& hit = planes.hits[i];
        if (hit.face >= gpu::kFaceInside) continue;
        EXPECT_TRUE(planes.ao[i] >= 0.0f && planes.ao[i] <= 1.0f) << planes.ao[i];
        const double p =
            blocked(glm::dvec3(fixture.march_world().origin + hit.cell) + glm::dvec3(hit.fraction), hit.face);
        if (p < 0.0) continue;
        const double count = std::round((1.0 - static_cast<double>(planes.ao[i])) * rays);
        const double pixel_variance = rays * p * (1.0 - p);
        ++stray.pixels;
        difference += count - rays * p;
        variance += pixel_variance;
        if (pixel_variance > kNormalVariance)
            stray.worst_pixel =
                std::max(stray.worst_pixel, std::abs(count - rays * p) / std::sqrt(pixel_variance));
    }
    stray.whole = difference / std::sqrt(variance);
    return stray;
}

void expect_close(const Scene& scene, const Expected& blocked, int pixels) {
    const Stray stray = compare(scene, blocked);
    EXPECT_GE(stray.pixels, pixels);
    EXPECT_LT(std::abs(stray.whole), kWholeSigmas);
    EXPECT_LT(stray.worst_pixel, kPixelSigmas);
}

TEST(AoTrace, plane_is_exactly_one_everywhere) {
    for (const Sequence sequence : {Sequence::sobol, Sequence::halton, Sequence::white}) {
        Scene scene = floor_scene();
        scene.settings.sequence = sequence;
        scene.camera = test::camera_towards({3.2, -20.0, 2.0}, {0, 0, 0}, 30.0);
        const test::FramePlanes planes = test::render_first_sample(scene);
        int on_floor = 0;
        for (std::size_t i = 0; i < planes.hits.size(); ++i) {
            on_floor += planes.hits[i].face == 5u ? 1 : 0;
            ASSERT_EQ(planes.ao[i], 1.0f) << i;
        }
        EXPECT_GT(on_floor, 200);
        EXPECT_EQ(planes.counters[gpu::kWorkAoRays], kRays * static_cast<gpu::uint>(on_floor));
    }
}

// The picture shows 3 voxels in front of the wall, where the height of the wall and the radius both matter.
Scene wall_scene(int height) {
    Scene scene = floor_scene();
    test::add_box(scene, {4, -26, 0}, {5, 26, height});
    scene.camera = test::camera_down({1.5, 0, 40}, 7.0);
    return scene;
}

double blocked_at_wall(glm::dvec3 position, double height) {
    return position.x < 4.0 ? test::blocked_by_wall(4.0 - position.x, height, double{kRadius}) : -1.0;
}

TEST(AoTrace, floor_before_a_low_wall_is_the_closed_form) {
    expect_close(
        wall_scene(3), [](glm::dvec3 p, gpu::uint) { return blocked_at_wall(p, 3.0); }, 350);
}

TEST(AoTrace, floor_before_a_wall_beyond_the_radius_is_the_closed_form) {
    expect_close(
        wall_scene(20),
        [](glm::dvec3 p, gpu::uint) { return test::disc_segment((4.0 - p.x) / double{kRadius}); }, 350);
}

TEST(AoTrace, every_sequence_agrees_with_the_closed_form) {
    for (const Sequence sequence : {Sequence::sobol, Sequence::halton}) {
        Scene scene = wall_scene(3);
        scene.settings.sequence = sequence;
        const Stray stray = compare(scene, [](glm::dvec3 p, gpu::uint) { return blocked_at_wall(p, 3.0); });
        EXPECT_LT(std::abs(stray.whole), kWholeSigmas);
        EXPECT_LT(stray.worst_pixel, 1.0)
            << "these sequences err less than white noise does in one of three pixels";
    }
}

// Without the part of the wall that the radius cuts off, or with the wall a tenth of a voxel away, the counts
// deviate.
TEST(AoTrace, comparison_rejects_a_wall_moved_by_a_tenth_of_a_voxel) {
    const Stray stray = compare(wall_scene(3), [](glm::dvec3 p, gpu::uint) {
        return blocked_at_wall(p - glm::dvec3(0.1, 0, 0), 3.0);
    });
    EXPECT_GT(std::abs(stray.whole), 2.0 * kWholeSigmas);
}

// The wall's top is as far from the floor as the slit is deep, and the slit is one voxel wide.
TEST(AoTrace, floor_of_a_slit_is_the_closed_form) {
    constexpr int kDepth = 6;
    Scene scene = floor_scene();
    test::add_box(scene, {-3, -26, 0}, {0, 26, kDepth});
    test::add_box(scene, {1, -26, 0}, {4, 26, kDepth});
    scene.camera = test::camera_down({0.5, 0.0, 40.0}, 1.3);
    expect_close(
        scene,
        [](glm::dvec3 p, gpu::uint) {
            return p.z == 0.0 ? test::blocked_in_slit(p.x, 1.0, double{kDepth}, double{kRadius}) : -1.0;
        },
        380);
}

TEST(AoTrace, all_three_faces_of_a_deep_corner_are_the_closed_form) {
    Scene scene = floor_scene();
    test::add_box(scene, {-1, -1, 0}, {0, 26, 26});
    test::add_box(scene, {-1, -1, 0}, {26, 0, 26});
    scene.camera = test::camera_towards({9, 9, 9}, {0.7, 0.7, 0.7}, 16.0);
    const auto blocked = [](glm::dvec3 p, gpu::uint face) {
        const int axis = static_cast<int>(face / 2u);
        return test::blocked_in_corner(p[(axis + 1) % 3], p[(axis + 2) % 3], double{kRadius});
    };
    expect_close(scene, blocked, 400);
}

// 7.5 voxels to a wall that is left only beyond the radius of 8: its voxel is entered inside, so it counts.
TEST(AoTrace, last_voxel_inside_the_radius_counts) {
    Scene scene = floor_scene();
    test::add_box(scene, {8, -26, 0}, {9, 26, 26});
    scene.settings.ao_radius = 8.0f;
    scene.settings.ao_rays = 8192;
    scene.camera = test::camera_down({0.5, 0.0, 40.0}, 0.02);
    expect_close(
        scene, [](glm::dvec3 p, gpu::uint) { return test::disc_segment((8.0 - p.x) / 8.0); }, 400);
}

TEST(AoTrace, camera_inside_a_solid_sees_no_opening) {
    Scene scene = floor_scene();
    scene.camera = Camera{.position = glm::dvec3(0.5, 0.5, -0.5)};
    const test::FramePlanes planes = test::render_first_sample(scene);
    for (const float open : planes.ao)
        ASSERT_EQ(open, 0.0f);
    EXPECT_EQ(planes.counters[gpu::kWorkAoRays], 0u);
}

TEST(AoTrace, floor_around_a_resting_sphere_is_the_closed_form) {
    Scene scene = floor_scene();
    scene.spheres.push_back({glm::dvec3(0.25, -0.5, 2.0), 2.0, 0});
    scene.settings.ao_radius = 4096.0f;
    scene.camera = test::camera_towards({4.0, -16.0, 14.0}, {0.25, -0.5, 0.5}, 24.0);
    const auto blocked = [](glm::dvec3 p, gpu::uint face) {
        return face == 5u ? test::blocked_by_resting_sphere(std::hypot(p.x - 0.25, p.y + 0.5), 2.0) : -1.0;
    };
    expect_close(scene, blocked, 150);
}

}  // namespace
}  // namespace voxilux
