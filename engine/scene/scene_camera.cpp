// Framing a box. In camera axes a corner (a, b, c) = (right, up, forward) is inside the picture of a camera
// at (u, v, w) when |a - u| <= tx (c - w) and |b - v| <= ty (c - w), tx and ty being the tangents of the half
// angles. Each inequality is linear, so over all corners they read
//   max(a - tx c) + tx w <= u <= min(a + tx c) - tx w
// and the same for v: the largest w that leaves both intervals non-empty is the nearest camera, and the
// middle of each interval centres the box. Seen with a field of view wider than the box's own corner that
// camera would sit on the corner itself, hence one more bound on w.

#include "scene/scene_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/assert.h"
#include "scene/angles.h"

namespace voxilux {
namespace {

constexpr double kEmptySceneDistance = 64.0;  // voxels: a model of the usual size would fit the picture

YawPitch direction_of(View view) {
    switch (view) {
        case View::three_quarter:
            return {120.0, -30.0};
        case View::front:
            return {90.0, 0.0};
        case View::back:
            return {-90.0, 0.0};
        case View::left:
            return {0.0, 0.0};
        case View::right:
            return {180.0, 0.0};
        case View::top:
            return {90.0, -90.0};
        case View::iso:
            return {135.0, -std::atan(std::numbers::sqrt2 / 2.0) * (180.0 / std::numbers::pi)};
    }
    VX_ASSERT(false);
    return {};
}

// The interval of camera offsets on one picture axis, at forward coordinate w: [low + t w, high - t w].
struct Slack {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();

    void hold(double across, double depth, double tangent) {
        low = std::max(low, across - tangent * depth);
        high = std::min(high, across + tangent * depth);
    }
};

}  // namespace

Camera framing_camera(const Box& box, View view, double aspect, double fov_y_deg) {
    VX_ASSERT(aspect > 0.0 && fov_y_deg > 0.0 && fov_y_deg < 180.0);
    const YawPitch direction = direction_of(view);
    Camera camera{.yaw_deg = direction.yaw_deg, .pitch_deg = direction.pitch_deg, .fov_y_deg = fov_y_deg};
    const glm::dmat3 basis = camera_basis(camera);
    if (box.empty()) {
        camera.position = -kEmptySceneDistance * basis[2];
        return camera;
    }
    const double tan_y = (1.0 - kFrameMargin) * sin_deg(fov_y_deg / 2.0) / cos_deg(fov_y_deg / 2.0);
    const double tan_x = aspect * tan_y;
    // Relative to the centre, so that a box far from the origin loses no bits.
    const glm::dvec3 centre = 0.5 * (glm::dvec3(box.lo) + glm::dvec3(box.hi));
    const glm::dvec3 half = 0.5 * glm::dvec3(box.extent());
    Slack across, upright;
    double nearest = std::numeric_limits<double>::infinity();
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 sign((corner & 1) * 2 - 1, (corner & 2) - 1, (corner & 4) / 2 - 1);
        const glm::dvec3 p = sign * half * basis;  // its coordinates along right, up, forward
        across.hold(p.x, p.z, tan_x);
        upright.hold(p.y, p.z, tan_y);
        nearest = std::min(nearest, p.z);
    }
    const double w = std::min({(across.high - across.low) / (2.0 * tan_x),
                               (upright.high - upright.low) / (2.0 * tan_y), nearest - kFrameClearance});
    const glm::dvec3 offset(0.5 * (across.low + across.high), 0.5 * (upright.low + upright.high), w);
    camera.position = centre + basis * offset;
    return camera;
}

Camera default_camera(const Box& box, double aspect) {
    return framing_camera(box, View::three_quarter, aspect);
}

Camera camera_of(const Scene& scene) {
    if (scene.camera) return *scene.camera;
    return default_camera(scene_bounds(scene), double(scene.settings.size.x) / double(scene.settings.size.y));
}

glm::dmat3 camera_basis(const Camera& camera) {
    const double sin_yaw = sin_deg(camera.yaw_deg), cos_yaw = cos_deg(camera.yaw_deg);
    const double sin_pitch = sin_deg(camera.pitch_deg), cos_pitch = cos_deg(camera.pitch_deg);
    return {glm::dvec3(sin_yaw, -cos_yaw, 0.0),
            glm::dvec3(-sin_pitch * cos_yaw, -sin_pitch * sin_yaw, cos_pitch),
            glm::dvec3(cos_pitch * cos_yaw, cos_pitch * sin_yaw, sin_pitch)};
}

YawPitch yaw_pitch_of(glm::dvec3 forward) {
    constexpr double kDegrees = 180.0 / std::numbers::pi;
    const double flat = std::hypot(forward.x, forward.y);
    VX_ASSERT(flat > 0.0 || forward.z != 0.0);
    const double yaw = flat > 0.0 ? std::atan2(forward.y, forward.x) * kDegrees : 90.0;
    return {yaw, std::atan2(forward.z, flat) * kDegrees};
}

}  // namespace voxilux
