#include "scene/camera_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "scene/animation.h"
#include "scene/scene_camera.h"

namespace voxilux {
namespace {

// Degrees, voxels: a few hundred operations on numbers below 10^4 in double.
constexpr double kRounding = 1e-9;

using Curve = std::function<double(double)>;

std::vector<CameraKey> keys_on(const std::vector<std::int64_t>& frames, const Curve& curve) {
    std::vector<CameraKey> keys;
    for (const std::int64_t frame : frames) {
        const double t = static_cast<double>(frame);
        keys.push_back({.frame = frame,
                        .camera = {.position = {curve(t), -2.0 * curve(t), 1.0},
                                   .yaw_deg = curve(t) / 10.0,
                                   .pitch_deg = curve(t) / 100.0}});
    }
    return keys;
}

// The largest distance from the curve at any frame from the first key to the last.
double distance_to(const std::vector<CameraKey>& keys, CameraPath path, const Curve& curve) {
    double worst = 0.0;
    for (std::int64_t frame = keys.front().frame; frame <= keys.back().frame; ++frame) {
        const Camera camera = camera_on_path(keys, path, frame);
        const double y = curve(static_cast<double>(frame));
        worst = std::max({worst, std::abs(camera.position.x - y), std::abs(camera.position.y + 2.0 * y),
                          std::abs(camera.position.z - 1.0), std::abs(camera.pitch_deg - y / 100.0),
                          std::abs(camera.yaw_deg - y / 10.0)});
    }
    return worst;
}

TEST(CameraPath, smooth_path_gives_every_parabola_back) {
    const Curve parabola = [](double t) { return 3.0 - 2.0 * t + 0.25 * t * t; };
    for (const auto& frames : {std::vector<std::int64_t>{0, 7, 10, 31, 40}, {5, 6, 60}, {0, 20, 40, 60}}) {
        const auto keys = keys_on(frames, parabola);
        EXPECT_LT(distance_to(keys, CameraPath::smooth, parabola), kRounding);
        EXPECT_GT(distance_to(keys, CameraPath::linear, parabola), 1.0)
            << "negative control: chords leave it";
    }
    const Curve cubic = [](double t) { return 0.01 * t * t * t; };
    EXPECT_GT(distance_to(keys_on({0, 7, 10, 31, 40}, cubic), CameraPath::smooth, cubic), 0.1);
}

TEST(CameraPath, linear_path_and_two_keys_go_straight) {
    const Curve line = [](double t) { return 4.0 + 1.5 * t; };
    EXPECT_LT(distance_to(keys_on({0, 3, 50}, line), CameraPath::linear, line), kRounding);
    EXPECT_LT(distance_to(keys_on({2, 30}, line), CameraPath::smooth, line), kRounding);
}

TEST(CameraPath, keys_are_met_exactly_and_ends_are_held) {
    const auto keys = keys_on({2, 9, 30}, [](double t) { return std::sin(t) * 100.0 / 3.0; });
    for (const CameraPath path : {CameraPath::smooth, CameraPath::linear}) {
        for (const CameraKey& key : keys)
            EXPECT_EQ(camera_on_path(keys, path, key.frame).position, key.camera.position);
        for (const std::int64_t frame : {-5, 0, 1})
            EXPECT_EQ(camera_on_path(keys, path, frame).yaw_deg, keys.front().camera.yaw_deg);
        EXPECT_EQ(camera_on_path(keys, path, 1000).position, keys.back().camera.position);
    }
}

// The steps before and after a key differ by a corner's whole angle or by the curvature of one frame.
TEST(CameraPath, smooth_path_has_no_corner) {
    const auto keys = keys_on({0, 1000, 1500, 4000}, [](double t) { return 100.0 * std::sin(t / 400.0); });
    const auto corner = [&](CameraPath path, std::int64_t frame) {
        const auto x = [&](std::int64_t f) { return camera_on_path(keys, path, f).position.x; };
        return std::abs(x(frame + 1) - 2.0 * x(frame) + x(frame - 1));
    };
    for (const std::int64_t frame : {1000, 1500}) {
        EXPECT_LT(corner(CameraPath::smooth, frame), 0.005);
        EXPECT_GT(corner(CameraPath::linear, frame), 0.05);
    }
}

TEST(CameraPath, yaw_turns_the_short_way_round) {
    const auto yaw_between = [](double from, double to, CameraPath path) {
        const std::vector<CameraKey> keys{{.frame = 0, .camera = {.yaw_deg = from}},
                                          {.frame = 4, .camera = {.yaw_deg = to}}};
        return camera_on_path(keys, path, 1).yaw_deg;
    };
    for (const CameraPath path : {CameraPath::smooth, CameraPath::linear}) {
        EXPECT_NEAR(std::remainder(yaw_between(350.0, 10.0, path) - 355.0, 360.0), 0.0, kRounding);
        EXPECT_NEAR(std::remainder(yaw_between(-170.0, 170.0, path) + 175.0, 360.0), 0.0, kRounding);
        EXPECT_NEAR(yaw_between(10.0, 100.0, path), 32.5, kRounding);
    }
}

TEST(CameraPath, point_looked_at_stays_in_the_middle) {
    const glm::dvec3 target(3.0, 4.0, 5.0);
    std::vector<CameraKey> keys;
    const glm::dvec3 places[] = {{40, 0, 9}, {0, 30, 40}, {-25, -1, 3}};
    for (const glm::dvec3& place : places) {
        const YawPitch look = yaw_pitch_of(target - place);
        keys.push_back({.frame = 10 * static_cast<std::int64_t>(keys.size()),
                        .camera = {.position = place, .yaw_deg = look.yaw_deg, .pitch_deg = look.pitch_deg},
                        .look_at = target});
    }
    const auto miss = [&](std::int64_t frame) {
        const Camera camera = camera_on_path(keys, CameraPath::smooth, frame);
        return glm::length(glm::normalize(target - camera.position) - camera_basis(camera)[2]);
    };
    for (std::int64_t frame = 0; frame <= 20; ++frame)
        EXPECT_LT(miss(frame), kRounding) << frame;
    keys[1].look_at.reset();  // negative control: now angles are interpolated, and the target drifts
    EXPECT_GT(miss(5), 0.01);
}

TEST(CameraPath, wild_keys_stay_cameras) {
    std::vector<CameraKey> keys;
    for (const auto& [pitch, fov] : {std::pair{-89.0, 1.0}, {90.0, 179.0}, {90.0, 170.0}, {-90.0, 0.5}})
        keys.push_back({.frame = 7 * static_cast<std::int64_t>(keys.size()),
                        .camera = {.pitch_deg = pitch, .fov_y_deg = fov}});
    for (std::int64_t frame = 0; frame <= 21; ++frame) {
        const Camera camera = camera_on_path(keys, CameraPath::smooth, frame);
        EXPECT_LE(std::abs(camera.pitch_deg), 90.0);
        EXPECT_GE(camera.fov_y_deg, 0.5);
        EXPECT_LE(camera.fov_y_deg, 179.0);
    }
}

const Camera kRest{.position = {10.0, -20.0, 7.0}, .yaw_deg = 95.0, .pitch_deg = -12.0, .fov_y_deg = 50.0};

TEST(TurntableCamera, radius_height_and_view_stay_the_same) {
    const Turntable table{.frames = 36};
    const glm::dvec2 axis(3.0, 1.5);
    const auto spread = [&](glm::dvec2 centre) {
        double low = 1e300, high = 0.0;
        for (std::int64_t frame = 1; frame <= 36; ++frame) {
            const Camera camera = camera_on_turntable(table, kRest, axis, frame);
            const double radius = glm::length(glm::dvec2(camera.position) - centre);
            low = std::min(low, radius);
            high = std::max(high, radius);
        }
        return high - low;
    };
    EXPECT_LT(spread(axis), kRounding);
    EXPECT_GT(spread(axis + glm::dvec2(0.01, 0.0)), 0.01)
        << "negative control: no circle about another centre";
    const glm::dvec2 arm = glm::dvec2(kRest.position) - axis;
    for (std::int64_t frame = 1; frame <= 36; ++frame) {
        const Camera camera = camera_on_turntable(table, kRest, axis, frame);
        EXPECT_EQ(camera.position.z, kRest.position.z);
        EXPECT_EQ(camera.pitch_deg, kRest.pitch_deg);
        EXPECT_EQ(camera.fov_y_deg, kRest.fov_y_deg);
        const double angle =
            std::atan2(camera.position.y - axis.y, camera.position.x - axis.x) - std::atan2(arm.y, arm.x);
        const double wanted = 10.0 * static_cast<double>(frame - 1);
        EXPECT_NEAR(std::remainder(angle * 180.0 / 3.14159265358979323846 - wanted, 360.0), 0.0, 1e-7);
        EXPECT_NEAR(std::remainder(camera.yaw_deg - kRest.yaw_deg - wanted, 360.0), 0.0, kRounding);
    }
}

TEST(TurntableLight, image_of_the_sky_goes_round_with_the_sun) {
    for (const auto& [turned, step] : {std::pair{Turned::camera, 0.0f}, std::pair{Turned::model, -90.0f},
                                       std::pair{Turned::light, 90.0f}}) {
        Scene scene;
        scene.sun.azimuth_deg = 10.0f;
        scene.sun.on = false;
        scene.sky.model = SkyModel::image;
        scene.sky.image = {{1, 1}, {glm::vec3(1.0f)}};
        scene.sky.rotation_deg = 20.0f;
        scene.camera = Camera{};
        scene.animation.turntable = Turntable{.frames = 4, .turned = turned};
        FramePlayer player(scene);
        EXPECT_EQ(player.show(1).sky.rotation_deg, 20.0f);
        EXPECT_FLOAT_EQ(player.show(2).sky.rotation_deg, 20.0f + step);
        EXPECT_EQ(player.has_new_light(), turned != Turned::camera);
        EXPECT_FLOAT_EQ(player.show(2).sun.azimuth_deg, 10.0f + step);
        EXPECT_FALSE(player.has_new_light());
        EXPECT_FLOAT_EQ(player.show(6).sky.rotation_deg, 20.0f + step);
    }
}

TEST(TurntableCamera, turn_begins_at_rest_and_closes) {
    const Turntable table{.frames = 12};
    const auto at = [&](std::int64_t frame) { return camera_on_turntable(table, kRest, {1.0, 2.0}, frame); };
    EXPECT_EQ(at(1).position, kRest.position);
    EXPECT_EQ(at(1).yaw_deg, kRest.yaw_deg);
    for (const std::int64_t frame : {-10, 2, 5, 12}) {
        EXPECT_EQ(at(frame).position, at(frame + 12).position);
        EXPECT_EQ(at(frame).yaw_deg, at(frame + 24).yaw_deg);
        EXPECT_NE(at(frame).position, at(frame + 11).position);
    }
    EXPECT_EQ(at(4).position, glm::dvec3(1.0 + 22.0, 2.0 + 9.0, 7.0))
        << "a quarter is exact: (9,-22) to (22,9)";
}

TEST(TurntableCamera, degrees_and_start_are_those_of_the_table) {
    const auto yaw = [](const Turntable& table, std::int64_t frame) {
        return camera_on_turntable(table, kRest, {0.0, 0.0}, frame).yaw_deg - kRest.yaw_deg;
    };
    EXPECT_EQ(yaw({.frames = 4, .degrees = -180.0}, 3), -90.0);
    EXPECT_EQ(yaw({.frames = 4, .degrees = 180.0, .start_deg = 30.0}, 1), 30.0);
    EXPECT_EQ(yaw({.frames = 4, .degrees = 180.0, .start_deg = 30.0}, 5), 30.0);
}

// The largest |x| or |y| of the box's corners in the picture, 1 being its edge, over all frames of a turn.
double farthest_corner(const Scene& scene, const Box& box) {
    const double aspect = double(scene.settings.size.x) / double(scene.settings.size.y);
    double farthest = 0.0;
    for (std::int64_t frame = 1; frame <= 24; ++frame) {
        const Camera camera = camera_of(scene_at_frame(scene, frame));
        const double tangent = std::tan(camera.fov_y_deg * 3.14159265358979323846 / 360.0);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 place((corner & 1) != 0 ? box.hi.x : box.lo.x,
                                   (corner & 2) != 0 ? box.hi.y : box.lo.y,
                                   (corner & 4) != 0 ? box.hi.z : box.lo.z);
            const glm::dvec3 p = (place - camera.position) * camera_basis(camera);
            EXPECT_GT(p.z, 0.0);
            farthest = std::max(
                {farthest, std::abs(p.x) / (p.z * tangent * aspect), std::abs(p.y) / (p.z * tangent)});
        }
    }
    return farthest;
}

TEST(TurntableCamera, scene_fits_in_every_frame) {
    Scene scene;
    scene.materials.resize(1);
    scene.models.push_back({.size = {90, 5, 7}, .voxels = {{0, 0, 0, 0}, {89, 4, 6, 0}}});
    scene.instances.push_back({.translation = {100, -30, 2}});
    scene.animation.turntable = Turntable{.frames = 24};
    const Box box = scene_bounds(scene);
    for (const View view : {View::three_quarter, View::front, View::right, View::iso, View::top}) {
        scene.camera = framing_camera(scene, view);
        const double farthest = farthest_corner(scene, box);
        EXPECT_LE(farthest, 1.0 - kFrameMargin + kRounding);
        EXPECT_GE(farthest, 0.97 * (1.0 - kFrameMargin)) << "no farther away than needed";
    }
    scene.camera = framing_camera(box, View::right, 16.0 / 9.0);  // negative control: the box at rest
    EXPECT_GT(farthest_corner(scene, box), 1.5);
}

// Seen from the camera, the sun stays in place when the model turns, and goes round when the light does.
TEST(TurntableCamera, model_or_light_turn_as_they_say) {
    const Camera rest{.position = {10.0, -20.0, 5.0}, .yaw_deg = 110.0, .pitch_deg = -20.0};
    const Sun sun{.azimuth_deg = 200.0f, .elevation_deg = 30.0f};
    const auto seen = [](const Camera& camera, const Sun& shining) {
        return glm::dvec3(shining.direction()) * camera_basis(camera);
    };
    Turntable table{.frames = 8, .turned = Turned::model};
    for (std::int64_t frame = 1; frame <= 9; ++frame) {
        const Camera camera = camera_on_turntable(table, rest, {1.0, 2.0}, frame);
        EXPECT_LT(glm::length(seen(camera, sun_on_turntable(table, sun, frame)) - seen(rest, sun)), 1e-5);
        EXPECT_NEAR(camera.yaw_deg, 110.0 - 45.0 * static_cast<double>((frame - 1) % 8), 1e-9);
    }
    table.turned = Turned::light;
    EXPECT_EQ(camera_on_turntable(table, rest, {1.0, 2.0}, 3).position, rest.position);
    EXPECT_NEAR(
        std::remainder(static_cast<double>(sun_on_turntable(table, sun, 3).azimuth_deg) - 290.0, 360.0), 0.0,
        1e-4);
    table.turned = Turned::camera;
    EXPECT_EQ(sun_on_turntable(table, sun, 3).azimuth_deg, sun.azimuth_deg);
}

}  // namespace
}  // namespace voxilux
