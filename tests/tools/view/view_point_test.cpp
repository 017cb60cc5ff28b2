#include "view/view_point.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace voxilux {
namespace {

constexpr glm::dvec2 kSize{200.0, 100.0};
constexpr Box kBox{{-8, -8, 0}, {8, 8, 9}};
constexpr double kTolerance = 1e-9;  // voxels: rounding of doubles at these distances

ViewPoint start() {
    return view_of(Camera{.position = {30, -40, 20}, .yaw_deg = 125, .pitch_deg = -20}, kBox);
}

ViewPoint parallel_start() {
    ViewPoint view = start();
    view.camera.projection = Projection::orthographic;
    view.camera.pixels_per_voxel = 3.5;
    return view;
}

// Where a point appears, in pixels: by the closed form of a pinhole camera, not by the code of the window.
glm::dvec2 pinhole_place(const Camera& camera, glm::dvec3 point) {
    const glm::dvec3 seen = glm::transpose(camera_basis(camera)) * (point - camera.position);
    const double scale = kSize.y / (2.0 * std::tan(glm::radians(camera.fov_y_deg) / 2.0)) / seen.z;
    return 0.5 * kSize + glm::dvec2(seen.x, -seen.y) * scale;
}

// The same for parallel rays: along the camera's axes, whatever the depth.
glm::dvec2 parallel_place(const Camera& camera, glm::dvec3 point) {
    const glm::dvec3 seen = glm::transpose(camera_basis(camera)) * (point - camera.position);
    return 0.5 * kSize + glm::dvec2(seen.x, -seen.y) * camera.pixels_per_voxel;
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
    const glm::dvec3 point =
        before.camera.position + 60.0 * ray_through(before.camera, place, kSize).direction;
    const ViewPoint after = zoomed(before, 3.0, place, kSize);
    EXPECT_LT(glm::length(pinhole_place(after.camera, point) - place), 1e-6);
    EXPECT_LT(glm::length(after.camera.position - point), glm::length(before.camera.position - point));
}

TEST(ViewPoint, place_of_a_point_by_parallel_rays_is_where_its_ray_begins) {
    const Camera camera = parallel_start().camera;
    const glm::dvec2 place{150.0, 20.0};
    const ViewRay ray = ray_through(camera, place, kSize);
    for (const double depth : {1.0, 70.0}) {
        const glm::dvec3 point = ray.start + depth * ray.direction;
        EXPECT_LT(glm::length(parallel_place(camera, point) - place), 1e-9);
        EXPECT_LT(glm::length(*place_of(camera, point, kSize) - place), 1e-9);
    }
}

TEST(ViewPoint, parallel_pan_and_zoom_keep_what_is_under_the_pointer) {
    const ViewPoint before = parallel_start();
    const glm::dvec2 place{150.0, 20.0};
    const glm::dvec3 point = ray_through(before.camera, place, kSize).start;
    const ViewPoint zoom = zoomed(before, 3.0, place, kSize);
    EXPECT_GT(zoom.camera.pixels_per_voxel, before.camera.pixels_per_voxel);
    EXPECT_LT(glm::length(parallel_place(zoom.camera, point) - place), 1e-9);
    const ViewPoint pan = panned(before, {12.0, -7.0}, kSize);
    EXPECT_LT(glm::length(parallel_place(pan.camera, point) - place - glm::dvec2(12.0, -7.0)), 1e-9);
}

TEST(ViewPoint, other_projection_shows_the_plane_through_the_centre_as_large) {
    const ViewPoint before = start();
    const ViewPoint parallel = with_other_projection(before, kBox, kSize);
    ASSERT_EQ(parallel.camera.projection, Projection::orthographic);
    const ViewPoint back = with_other_projection(parallel, kBox, kSize);
    ASSERT_EQ(back.camera.projection, Projection::perspective);
    const glm::dmat3 basis = camera_basis(before.camera);
    for (const glm::dvec3 point : {before.centre + 2.0 * basis[0], before.centre - 1.5 * basis[1]}) {
        const glm::dvec2 place = pinhole_place(before.camera, point);
        EXPECT_LT(glm::length(parallel_place(parallel.camera, point) - place), 1e-6);
        EXPECT_LT(glm::length(pinhole_place(back.camera, point) - place), 1e-6);
    }
}

TEST(ViewPoint, parallel_rays_see_all_of_the_box_however_the_view_turns) {
    const auto depths_of_box = [](const ViewPoint& view) {
        double nearest = 1e9;
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 corner{(i & 1) != 0 ? kBox.hi.x : kBox.lo.x,
                                    (i & 2) != 0 ? kBox.hi.y : kBox.lo.y,
                                    (i & 4) != 0 ? kBox.hi.z : kBox.lo.z};
            nearest =
                std::min(nearest, glm::dot(corner - view.camera.position, camera_basis(view.camera)[2]));
        }
        return nearest;
    };
    Camera facing = parallel_start().camera;
    facing.yaw_deg = 90.0;
    facing.pitch_deg = 0.0;
    const ViewPoint view = view_of(framing_camera(kBox, facing, kSize), kBox);
    double unmoved = depths_of_box(view);
    double moved = unmoved;
    const ViewPoint back = stepped_back(view, kBox);
    for (double turn = 10.0; turn < 200.0; turn += 10.0) {
        unmoved = std::min(unmoved, depths_of_box(orbited(view, {turn, turn / 5.0}, kSize)));
        moved = std::min(moved, depths_of_box(orbited(back, {turn, turn / 5.0}, kSize)));
    }
    EXPECT_GT(moved, 0.0);
    EXPECT_LT(unmoved, 0.0) << "where a framing camera stands, it would not";
}

}  // namespace
}  // namespace voxilux
