#include "scene/camera_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/assert.h"
#include "scene/angles.h"
#include "scene/scene_camera.h"

namespace voxilux {
namespace {

// One quantity of the camera at every key.
struct Curve {
    std::vector<double> times;  // rising
    std::vector<double> values;
};

double chord(const Curve& curve, std::size_t i) {
    return (curve.values[i + 1] - curve.values[i]) / (curve.times[i + 1] - curve.times[i]);
}

// Slope of the parabola through three keys. At an end it is that of the parabola through the last three: the
// mean of its slopes at two neighbouring keys is the chord between them.
double slope(const Curve& curve, std::size_t i) {
    const std::size_t last = curve.times.size() - 1;
    if (last == 1) return chord(curve, 0);
    if (i == 0) return 2.0 * chord(curve, 0) - slope(curve, 1);
    if (i == last) return 2.0 * chord(curve, last - 1) - slope(curve, last - 1);
    const double before = curve.times[i] - curve.times[i - 1];
    const double after = curve.times[i + 1] - curve.times[i];
    return (after * chord(curve, i - 1) + before * chord(curve, i)) / (before + after);
}

// Value between keys `i` and `i + 1`, at the fraction `u` of the interval.
double on_curve(const Curve& curve, CameraPath path, std::size_t i, double u) {
    const double from = curve.values[i];
    const double to = curve.values[i + 1];
    if (path == CameraPath::linear) return from + u * (to - from);
    const double length = curve.times[i + 1] - curve.times[i];
    // Hermite's cubic as a straight line and what bends it, so that equal values without slope stay equal.
    const double bend_from = length * slope(curve, i) - (to - from);
    const double bend_to = length * slope(curve, i + 1) - (to - from);
    return from + u * (to - from) + u * (1.0 - u) * ((1.0 - u) * bend_from - u * bend_to);
}

template <class Value>
Curve curve_of(std::span<const CameraKey> keys, const Value& value) {
    Curve curve;
    for (const CameraKey& key : keys) {
        curve.times.push_back(static_cast<double>(key.frame));
        curve.values.push_back(value(key));
    }
    return curve;
}

// The yaws, each written so that it is at most half a turn from the one before.
Curve yaw_curve(std::span<const CameraKey> keys) {
    Curve curve = curve_of(keys, [](const CameraKey& key) { return key.camera.yaw_deg; });
    for (std::size_t i = 1; i < curve.values.size(); ++i) {
        const double before = curve.values[i - 1];
        curve.values[i] = before + std::remainder(curve.values[i] - before, 360.0);
    }
    return curve;
}

}  // namespace

Camera camera_on_path(std::span<const CameraKey> keys, CameraPath path, std::int64_t frame) {
    VX_ASSERT(!keys.empty());
    const auto after = std::ranges::upper_bound(keys, frame, {}, &CameraKey::frame);
    if (after == keys.begin()) return keys.front().camera;
    const CameraKey& before = *(after - 1);
    if (after == keys.end() || before.frame == frame) return before.camera;
    const auto i = static_cast<std::size_t>(after - keys.begin()) - 1;
    const double u =
        static_cast<double>(frame - before.frame) / static_cast<double>(after->frame - before.frame);
    const auto number = [&](const Curve& curve) { return on_curve(curve, path, i, u); };
    const auto point = [&](const auto& value) {
        glm::dvec3 p;
        for (int axis = 0; axis < 3; ++axis)
            p[axis] = number(curve_of(keys, [&](const CameraKey& key) { return value(key)[axis]; }));
        return p;
    };
    const auto fov = [](const CameraKey& key) { return key.camera.fov_y_deg; };
    const auto [narrow, wide] = std::ranges::minmax_element(keys, {}, fov);
    Camera camera = before.camera;
    camera.position = point([](const CameraKey& key) { return key.camera.position; });
    camera.yaw_deg = number(yaw_curve(keys));
    camera.fov_y_deg = std::clamp(number(curve_of(keys, fov)), fov(*narrow), fov(*wide));
    const double pitch = number(curve_of(keys, [](const CameraKey& key) { return key.camera.pitch_deg; }));
    camera.pitch_deg = std::clamp(pitch, -90.0, 90.0);
    if (!std::ranges::all_of(keys, [](const CameraKey& key) { return key.look_at.has_value(); }))
        return camera;
    const glm::dvec3 forward = point([](const CameraKey& key) { return *key.look_at; }) - camera.position;
    if (forward == glm::dvec3(0.0)) return camera;
    const YawPitch direction = yaw_pitch_of(forward);
    camera.yaw_deg = direction.yaw_deg;
    camera.pitch_deg = direction.pitch_deg;
    return camera;
}

double angle_of(const Turntable& turntable, std::int64_t frame) {
    VX_ASSERT(turntable.frames >= 1);
    const std::int64_t place = ((frame - 1) % turntable.frames + turntable.frames) % turntable.frames;
    return turntable.start_deg +
           turntable.degrees * static_cast<double>(place) / static_cast<double>(turntable.frames);
}

Camera camera_on_turntable(const Turntable& turntable, const Camera& rest, glm::dvec2 axis,
                           std::int64_t frame) {
    if (turntable.turned == Turned::light) return rest;
    const double angle = (turntable.turned == Turned::model ? -1.0 : 1.0) * angle_of(turntable, frame);
    if (angle == 0.0) return rest;
    const double sine = sin_deg(angle), cosine = cos_deg(angle);
    const glm::dvec2 arm = glm::dvec2(rest.position) - axis;
    Camera camera = rest;
    camera.position.x = axis.x + cosine * arm.x - sine * arm.y;
    camera.position.y = axis.y + sine * arm.x + cosine * arm.y;
    camera.yaw_deg = rest.yaw_deg + angle;
    return camera;
}

Sun sun_on_turntable(const Turntable& turntable, const Sun& rest, std::int64_t frame) {
    Sun sun = rest;
    sun.azimuth_deg = azimuth_on_turntable(turntable, rest.azimuth_deg, frame);
    return sun;
}

float azimuth_on_turntable(const Turntable& turntable, float rest_deg, std::int64_t frame) {
    if (turntable.turned == Turned::camera) return rest_deg;
    const double angle = (turntable.turned == Turned::model ? -1.0 : 1.0) * angle_of(turntable, frame);
    return static_cast<float>(std::remainder(double{rest_deg} + angle, 360.0));
}

}  // namespace voxilux
