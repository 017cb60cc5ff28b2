#include "view/view_point.h"

#include <gtest/gtest.h>

namespace voxilux {
namespace {

constexpr glm::dvec2 kSize{200.0, 100.0};
constexpr double kTolerance = 1e-9;  // voxels: rounding of doubles at these distances

ViewPoint start() {
    return view_of(Camera{.position = {30, -40, 20}, .yaw_deg = 125, .pitch_deg = -20},
                   {{-8, -8, 0}, {8, 8, 9}});
}

// Where a point appears, in pixels: by the closed form of a pinhole camera, not by the code of the window.
glm::dvec2 pinhole_place(const Camera& camera, glm::dvec3 point) {
    const glm::dvec3 seen = glm::transpose(camera_basis(camera)) * (point - camera.position);
    const double scale = kSize.y / (2.0 * std::tan(glm::radians(camera.fov_y_deg) / 2.0)) / seen.z;
    return 0.5 * kSize + glm::dvec2(seen.x, -seen.y) * scale;
}

TEST(ViewPoint, place_of_a_point_is_that_of_a_pinhole_camera) {
    const Camera camera = start().camera;
    const std::optional<glm::dvec2> place = place_of(camera, {3, -2, 4}, kSize);
    ASSERT_TRUE(place);
    EXPECT_LT(glm::length(*place - pinhole_place(camera, {3, -2, 4})), 1e-9);
    EXPECT_FALSE(place_of(camera, camera.position * 2.0, kSize)) << "behind the camera";
}

TEST(ViewPoint, orbit_keeps_the_distance_and_the_centre_in_the_middle) {
    const ViewPoint before = start();
    const ViewPoint after = orbited(before, {17.0, 5.0}, kSize);
    EXPECT_NEAR(glm::length(after.camera.position - after.centre),
                glm::length(before.camera.position - before.centre), kTolerance);
    EXPECT_LT(glm::length(pinhole_place(after.camera, after.centre) - 0.5 * kSize), 1e-6);
    EXPECT_GT(glm::length(after.camera.position - before.camera.position), 1.0);
}

TEST(ViewPoint, pan_moves_the_centre_with_the_pointer) {
    const ViewPoint before = start();
    const ViewPoint after = panned(before, {12.0, -7.0}, kSize);
    const glm::dvec2 way =
        pinhole_place(after.camera, before.centre) - pinhole_place(before.camera, before.centre);
    EXPECT_LT(glm::length(way - glm::dvec2(12.0, -7.0)), 1e-6);
}

TEST(ViewPoint, zoom_keeps_what_is_under_the_pointer) {
    const ViewPoint before = start();
    const glm::dvec2 place{150.0, 20.0};
    const glm::dvec3 point = before.camera.position + 60.0 * direction_through(before.camera, place, kSize);
    const ViewPoint after = zoomed(before, 3.0, place, kSize);
    EXPECT_LT(glm::length(pinhole_place(after.camera, point) - place), 1e-6);
    EXPECT_LT(glm::length(after.camera.position - point), glm::length(before.camera.position - point));
}

}  // namespace
}  // namespace voxilux
