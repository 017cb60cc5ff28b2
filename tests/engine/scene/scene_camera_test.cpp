#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <fmt/format.h>

#include "scene/angles.h"
#include "scene/scene_camera.h"

namespace voxilux {
namespace {

// The largest |x| and |y| of the box's corners in the picture, whose sides are at 1. Infinite when a corner
// is not in front of the camera.
glm::dvec2 reach_in_picture(const Camera& camera, const Box& box, double aspect) {
    const glm::dmat3 basis = camera_basis(camera);
    const double tan_y = std::tan(camera.fov_y_deg * std::numbers::pi / 360.0);
    glm::dvec2 reach(0.0);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p((corner & 1) != 0 ? box.hi.x : box.lo.x, (corner & 2) != 0 ? box.hi.y : box.lo.y,
                           (corner & 4) != 0 ? box.hi.z : box.lo.z);
        const glm::dvec3 d = p - camera.position;
        const double depth = glm::dot(d, basis[2]);
        if (!(depth > 0.0)) return glm::dvec2(std::numeric_limits<double>::infinity());
        reach.x = std::max(reach.x, std::abs(glm::dot(d, basis[0])) / (depth * tan_y * aspect));
        reach.y = std::max(reach.y, std::abs(glm::dot(d, basis[1])) / (depth * tan_y));
    }
    return reach;
}

// Relative rounding of a position of size 2^30 next to a box of size 1 is 2^-22; nearer scenes are far
// better.
constexpr double kCameraRounding = 1e-6;

double nearest_depth(const Camera& camera, const Box& box) {
    const glm::dvec3 forward = camera_basis(camera)[2];
    const glm::dvec3 corner =
        glm::mix(glm::dvec3(box.hi), glm::dvec3(box.lo), glm::greaterThan(forward, glm::dvec3(0)));
    return glm::dot(corner - camera.position, forward);
}

// True when the box touches the margin; false when only the clearance keeps the camera away.
bool expect_framed(const Camera& camera, const Box& box, double aspect) {
    const glm::dvec2 reach = reach_in_picture(camera, box, aspect);
    const double largest = std::max(reach.x, reach.y);
    const auto shown = [&] {
        return fmt::format("box ({} {} {}) to ({} {} {}), aspect {}, yaw {}, fov {}", box.lo.x, box.lo.y,
                           box.lo.z, box.hi.x, box.hi.y, box.hi.z, aspect, camera.yaw_deg, camera.fov_y_deg);
    };
    EXPECT_LE(largest, 1.0 - kFrameMargin + kCameraRounding) << shown();
    if (largest > 1.0 - kFrameMargin - kCameraRounding) return true;
    EXPECT_NEAR(nearest_depth(camera, box), kFrameClearance, kCameraRounding) << shown();
    return false;
}

void expect_tight(const Camera& camera, const Box& box, double aspect) {
    EXPECT_TRUE(expect_framed(camera, box, aspect)) << aspect;
}

TEST(SceneCamera, many_boxes_are_framed_tightly) {
    std::mt19937 random(20240607);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    double narrowest_loose = 180.0;  // degrees; below it every box touches the margin
    for (int trial = 0; trial < 2000; ++trial) {
        const int largest = 1 << below(12);
        const glm::ivec3 lo(below(2001) - 1000, below(2001) - 1000, below(2001) - 1000);
        const Box box{lo, lo + glm::ivec3(1 + below(largest), 1 + below(largest), 1 + below(largest))};
        const double aspect = std::exp2(below(2001) / 100.0 - 10.0);  // 1/1024 to 1024
        const auto view = static_cast<View>(below(8));
        const double fov_y_deg = 1.0 + below(170);
        const bool tight = expect_framed(framing_camera(box, view, aspect, fov_y_deg), box, aspect);
        if (!tight) narrowest_loose = std::min(narrowest_loose, fov_y_deg);
    }
    EXPECT_GT(narrowest_loose, 75.0);
}

TEST(SceneCamera, named_boxes_are_framed_tightly) {
    const int far = kMaxCoordinate - 1;
    for (const Box& box :
         {Box{{0, 0, 0}, {1, 1, 1}}, Box{{0, 0, 0}, {2000, 2000, 2000}}, Box{{0, 0, 0}, {1, 1, 2000}},
          Box{{-far, -far, -far}, {far, far, far}}, Box{{far, far, far}, {far + 1, far + 1, far + 1}}})
        for (const double aspect : {1.0, 640.0 / 360.0, 1024.0, 1.0 / 1024.0})
            expect_tight(default_camera(box, aspect), box, aspect);
}

// Negative control: a camera a hundredth nearer, or a box one voxel larger, must not pass.
TEST(SceneCamera, tightness_check_sees_a_small_change) {
    const Box box{{0, 0, 0}, {20, 10, 8}};
    Camera camera = default_camera(box, 1.5);
    const glm::dvec2 exact = reach_in_picture(camera, box, 1.5);
    ASSERT_NEAR(std::max(exact.x, exact.y), 1.0 - kFrameMargin, kCameraRounding);
    const glm::dvec2 larger = reach_in_picture(camera, {{0, 0, 0}, {21, 10, 8}}, 1.5);
    EXPECT_GT(std::max(larger.x, larger.y), 1.0 - kFrameMargin + 100.0 * kCameraRounding);
    camera.position += 0.01 * glm::length(camera.position) * camera_basis(camera)[2];
    const glm::dvec2 nearer = reach_in_picture(camera, box, 1.5);
    EXPECT_GT(std::max(nearer.x, nearer.y), 1.0 - kFrameMargin + 100.0 * kCameraRounding);
}

// The extent of a box across and upright in the image, in its coordinates from -1 to 1.
glm::dvec2 parallel_reach(const Camera& camera, const Box& box, glm::dvec2 size) {
    const glm::dmat3 basis = camera_basis(camera);
    glm::dvec2 reach(0.0);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p(corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y,
                           corner & 4 ? box.hi.z : box.lo.z);
        const glm::dvec3 d = p - camera.position;
        EXPECT_GE(glm::dot(d, basis[2]), kParallelClearance - kCameraRounding);
        const glm::dvec2 at(glm::dot(d, basis[0]), glm::dot(d, basis[1]));
        reach = glm::max(reach, glm::abs(at) * 2.0 * camera.pixels_per_voxel / size);
    }
    return reach;
}

TEST(SceneCamera, orthographic_views_frame_boxes_tightly) {
    std::mt19937 random(20240608);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    for (int trial = 0; trial < 500; ++trial) {
        const glm::ivec3 lo(below(2001) - 1000, below(2001) - 1000, below(2001) - 1000);
        const Box box{lo, lo + glm::ivec3(1 + below(99), 1 + below(99), 1 + below(99))};
        const glm::dvec2 size(1 + below(900), 1 + below(900));
        Camera looking = looking_along(static_cast<View>(below(8)));
        looking.projection = Projection::orthographic;
        const Camera camera = framing_camera(box, looking, size);
        const glm::dvec2 reach = parallel_reach(camera, box, size);
        EXPECT_NEAR(std::max(reach.x, reach.y), 1.0 - kFrameMargin, kCameraRounding);
        looking.pixels_per_voxel = 2.5;
        EXPECT_EQ(framing_camera(box, looking, size).pixels_per_voxel, 2.5);
    }
}

TEST(SceneCamera, sprites_are_as_large_as_the_scene) {
    Scene scene;
    scene.models.push_back({.size = {3, 4, 5}, .voxels = {{0, 0, 0, 0}, {2, 3, 4, 0}}});
    scene.instances.push_back({.model = 0});
    Camera looking = looking_along(View::front);
    looking.projection = Projection::orthographic;
    looking.pixels_per_voxel = 7.0;
    EXPECT_EQ(sprite_size(scene, looking), glm::ivec2(21, 35));
    looking.yaw_deg = 0.0;
    EXPECT_EQ(sprite_size(scene, looking), glm::ivec2(28, 35));
    looking.pixels_per_voxel = 4000.0;
    scene.instances.push_back({.model = 0, .translation = {100, 0, 0}});
    looking.yaw_deg = 90.0;
    EXPECT_THROW((void)sprite_size(scene, looking), Error);
}

TEST(SceneCamera, default_view_shows_front_right_and_top) {
    const glm::dvec3 forward = camera_basis(default_camera({{0, 0, 0}, {4, 4, 4}}, 1.0))[2];
    EXPECT_GT(forward.y, 0.0);
    EXPECT_LT(forward.x, 0.0);
    EXPECT_LT(forward.z, 0.0);
    EXPECT_GT(std::abs(forward.y), std::abs(forward.x));  // the front more than the side
}

TEST(SceneCamera, empty_scene_looks_at_the_origin) {
    const Camera camera = default_camera({}, 1.0);
    const glm::dvec3 forward = camera_basis(camera)[2];
    EXPECT_NEAR(glm::length(camera.position), 64.0, 1e-12);
    EXPECT_LT(glm::length(glm::normalize(-camera.position) - forward), 1e-15 * 4);
    EXPECT_EQ(camera_of(Scene{}).position, camera.position);
}

TEST(SceneCamera, views_look_from_where_they_say) {
    const Box box{{-1, -1, -1}, {1, 1, 1}};
    const auto from = [&](View view) { return glm::normalize(framing_camera(box, view, 1.0).position); };
    EXPECT_EQ(from(View::front), glm::dvec3(0, -1, 0));
    EXPECT_EQ(from(View::back), glm::dvec3(0, 1, 0));
    EXPECT_EQ(from(View::left), glm::dvec3(-1, 0, 0));
    EXPECT_EQ(from(View::right), glm::dvec3(1, 0, 0));
    EXPECT_EQ(from(View::top), glm::dvec3(0, 0, 1));
    const glm::dvec3 iso = camera_basis(framing_camera(box, View::iso, 1.0))[2];
    EXPECT_LT(glm::length(iso - glm::dvec3(-1, 1, -1) / std::sqrt(3.0)), 1e-15 * 4);
}

TEST(SceneCamera, basis_is_orthonormal_and_right_handed) {
    for (double yaw = -400.0; yaw <= 400.0; yaw += 12.5) {
        for (double pitch = -90.0; pitch <= 90.0; pitch += 7.5) {
            const glm::dmat3 basis = camera_basis({.yaw_deg = yaw, .pitch_deg = pitch});
            const glm::dmat3 gram = glm::transpose(basis) * basis;
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j)
                    ASSERT_NEAR(gram[i][j], i == j ? 1.0 : 0.0, 1e-15 * 4) << yaw << ' ' << pitch;
            ASSERT_LT(glm::length(glm::cross(basis[0], basis[1]) + basis[2]), 1e-15 * 4);
            ASSERT_EQ(basis[0].z, 0.0);  // no roll
            ASSERT_GE(basis[1].z, 0.0);  // never upside down
        }
    }
}

TEST(SceneCamera, axis_views_have_exact_axes) {
    EXPECT_EQ(camera_basis({.yaw_deg = 90.0})[2], glm::dvec3(0, 1, 0));
    EXPECT_EQ(camera_basis({.yaw_deg = -180.0})[2], glm::dvec3(-1, 0, 0));
    EXPECT_EQ(camera_basis({.yaw_deg = 90.0, .pitch_deg = -90.0}), glm::dmat3(1, 0, 0, 0, 1, 0, 0, 0, -1));
}

// Towards the zenith the basis has a limit, and it is what pitch 90 gives.
TEST(SceneCamera, straight_up_is_the_limit_of_steep) {
    const glm::dmat3 straight = camera_basis({.yaw_deg = 33.0, .pitch_deg = 90.0});
    const glm::dmat3 steep = camera_basis({.yaw_deg = 33.0, .pitch_deg = 90.0 - 1e-9});
    for (int i = 0; i < 3; ++i)
        EXPECT_LT(glm::length(straight[i] - steep[i]), 2e-11);  // 1e-9 degrees in radians
}

TEST(SceneCamera, yaw_pitch_inverts_the_basis) {
    for (const glm::dvec3& forward :
         {glm::dvec3(3, -4, 12), glm::dvec3(1e-300, 0, 0), glm::dvec3(-1e200, 1e200, 1e200),
          glm::dvec3(0, 0, 5), glm::dvec3(0, 0, -5), glm::dvec3(0, -1, 0)}) {
        const YawPitch direction = yaw_pitch_of(forward);
        const glm::dvec3 back =
            camera_basis({.yaw_deg = direction.yaw_deg, .pitch_deg = direction.pitch_deg})[2];
        const double largest = std::max({std::abs(forward.x), std::abs(forward.y), std::abs(forward.z)});
        EXPECT_LT(glm::length(back - glm::normalize(forward / largest)), 1e-15 * 4);
    }
}

TEST(Sun, direction_has_closed_forms) {
    EXPECT_EQ((Sun{.azimuth_deg = 0, .elevation_deg = 0}.direction()), glm::vec3(1, 0, 0));
    EXPECT_EQ((Sun{.azimuth_deg = 90, .elevation_deg = 0}.direction()), glm::vec3(0, 1, 0));
    EXPECT_EQ((Sun{.azimuth_deg = 270, .elevation_deg = 0}.direction()), glm::vec3(0, -1, 0));
    EXPECT_EQ((Sun{.azimuth_deg = 123, .elevation_deg = 90}.direction()), glm::vec3(0, 0, 1));
    EXPECT_EQ((Sun{.azimuth_deg = 123, .elevation_deg = -90}.direction()), glm::vec3(0, 0, -1));
    const glm::vec3 d = Sun{.azimuth_deg = 45, .elevation_deg = 30}.direction();
    const float flat = static_cast<float>(std::sqrt(0.375));  // cos 30 * cos 45
    EXPECT_FLOAT_EQ(d.x, flat);
    EXPECT_FLOAT_EQ(d.y, flat);
    EXPECT_FLOAT_EQ(d.z, 0.5f);
}

TEST(Angles, sine_and_cosine_agree_with_radians) {
    for (double angle = -1000.0; angle <= 1000.0; angle += 0.37) {
        // The argument in radians is rounded to 2^-44 at 17 turns; the sine moves by as much.
        EXPECT_NEAR(sin_deg(angle), std::sin(angle * (std::numbers::pi / 180.0)), 1e-14) << angle;
        EXPECT_NEAR(cos_deg(angle), std::cos(angle * (std::numbers::pi / 180.0)), 1e-14) << angle;
    }
    EXPECT_EQ(sin_deg(180.0), 0.0);
    EXPECT_EQ(cos_deg(90.0), 0.0);
    EXPECT_EQ(cos_deg(3690.0), 0.0);
}

}  // namespace
}  // namespace voxilux
