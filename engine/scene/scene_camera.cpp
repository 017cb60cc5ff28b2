// Framing a box. In camera axes a corner (a, b, c) = (right, up, forward) is inside the image of a camera
// at (u, v, w) when |a - u| <= tx (c - w) and |b - v| <= ty (c - w), tx and ty being the tangents of the half
// angles. Each inequality is linear, so over all corners they read
//   max(a - tx c) + tx w <= u <= min(a + tx c) - tx w
// and the same for v: the largest w that leaves both intervals non-empty is the nearest camera, and the
// middle of each interval centres the box. With a field of view wider than the corner of the box, that camera
// would sit on the corner itself, hence one more bound on w.

#include "scene/scene_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "base/assert.h"
#include "base/error.h"
#include "scene/angles.h"
#include "scene/animation.h"

namespace voxilux {
namespace {

constexpr double kEmptySceneDistance = 64.0;     // voxels: a model of the usual size would fit the image
constexpr double kWidestPanoramaFraming = 90.0;  // degrees
constexpr double kMaxSpriteSide = 65535.0;       // pixels, as of [render] size
// What the rounding of sines may add to the extent of a scene, pixels.
constexpr double kPixelRounding = 1e-6;

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
        case View::bottom:
            return {90.0, 90.0};
        case View::iso:
            return {135.0, -std::atan(std::numbers::sqrt2 / 2.0) * (180.0 / std::numbers::pi)};
    }
    VX_ASSERT(false);
    return {};
}

// The interval of camera offsets on one image axis, at forward coordinate w: [low + t w, high - t w].
struct Slack {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();

    void hold(double across, double depth, double tangent) {
        low = std::max(low, across - tangent * depth);
        high = std::min(high, across + tangent * depth);
    }
};

// Corners of the polygon around a circle that stands for it: the camera is at most 0.2 % too far away.
constexpr int kCircleCorners = 48;

// The corners of a box relative to its centre, so that a box far from the origin loses no bits.
std::vector<glm::dvec3> corners_of(const Box& box) {
    const glm::dvec3 half = 0.5 * glm::dvec3(box.extent());
    std::vector<glm::dvec3> corners;
    for (int corner = 0; corner < 8; ++corner)
        corners.push_back(half * glm::dvec3((corner & 1) * 2 - 1, (corner & 2) - 1, (corner & 4) / 2 - 1));
    return corners;
}

// The same for the upright cylinder around a box: what the box covers when it turns.
std::vector<glm::dvec3> corners_of_turning(const Box& box) {
    const glm::dvec3 half = 0.5 * glm::dvec3(box.extent());
    const double radius = glm::length(glm::dvec2(half)) / cos_deg(180.0 / kCircleCorners);
    std::vector<glm::dvec3> corners;
    for (int i = 0; i < kCircleCorners; ++i) {
        const glm::dvec3 side = direction_from_deg(360.0 * i / kCircleCorners, 0.0);
        for (const double z : {-half.z, half.z})
            corners.emplace_back(radius * side.x, radius * side.y, z);
    }
    return corners;
}

Camera camera_around(const Box& box, std::span<const glm::dvec3> corners, const Camera& looking,
                     double aspect) {
    VX_ASSERT(aspect > 0.0 && looking.fov_y_deg > 0.0 && looking.fov_y_deg < 180.0);
    Camera camera = looking;
    const glm::dmat3 basis = camera_basis(camera);
    if (box.empty()) {
        camera.position = -kEmptySceneDistance * basis[2];
        return camera;
    }
    const double half_angle_deg = looking.fov_y_deg / 2.0;
    const double tan_y = (1.0 - kFrameMargin) * sin_deg(half_angle_deg) / cos_deg(half_angle_deg);
    const double tan_x = aspect * tan_y;
    const glm::dvec3 centre = 0.5 * (glm::dvec3(box.lo) + glm::dvec3(box.hi));
    Slack across, upright;
    double nearest = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& corner : corners) {
        const glm::dvec3 p = corner * basis;  // its coordinates along right, up, forward
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

// What a box covers in camera axes, relative to its centre.
struct Extent {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
};

Extent extent_of(std::span<const glm::dvec3> corners, const glm::dmat3& basis) {
    Extent extent;
    for (const glm::dvec3& corner : corners) {
        const glm::dvec3 p = corner * basis;
        extent.low = glm::min(extent.low, p);
        extent.high = glm::max(extent.high, p);
    }
    return extent;
}

Camera parallel_camera_around(const Box& box, std::span<const glm::dvec3> corners, const Camera& looking,
                              glm::dvec2 size) {
    Camera camera = looking;
    const glm::dmat3 basis = camera_basis(camera);
    const bool is_chosen = looking.pixels_per_voxel > 0.0;
    if (box.empty()) {
        camera.position = -kEmptySceneDistance * basis[2];
        if (!is_chosen) camera.pixels_per_voxel = size.y / kEmptySceneDistance;
        return camera;
    }
    const Extent extent = extent_of(corners, basis);
    const glm::dvec2 free = (1.0 - kFrameMargin) * size / glm::dvec2(extent.high - extent.low);
    if (!is_chosen) camera.pixels_per_voxel = std::min(free.x, free.y);
    const glm::dvec3 centre = 0.5 * (glm::dvec3(box.lo) + glm::dvec3(box.hi));
    const glm::dvec3 middle = 0.5 * (extent.low + extent.high);
    camera.position = centre + basis * glm::dvec3(middle.x, middle.y, extent.low.z - kParallelClearance);
    return camera;
}

Camera camera_around(const Box& box, std::span<const glm::dvec3> corners, const Camera& looking,
                     glm::dvec2 size) {
    if (looking.projection == Projection::orthographic)
        return parallel_camera_around(box, corners, looking, size);
    Camera lens = looking;
    const bool is_panorama = looking.projection != Projection::perspective;
    if (is_panorama) lens.fov_y_deg = std::min(lens.fov_y_deg, kWidestPanoramaFraming);
    Camera camera = camera_around(box, corners, lens, size.x / size.y);
    camera.fov_y_deg = looking.fov_y_deg;
    return camera;
}

// What the camera of a scene has to show.
std::vector<glm::dvec3> corners_to_show(const Scene& scene, const Box& box) {
    return scene.animation.turntable ? corners_of_turning(box) : corners_of(box);
}

}  // namespace

Camera looking_along(View view, double fov_y_deg) {
    const YawPitch direction = direction_of(view);
    return {.yaw_deg = direction.yaw_deg, .pitch_deg = direction.pitch_deg, .fov_y_deg = fov_y_deg};
}

Camera framing_camera(const Box& box, View view, double aspect, double fov_y_deg) {
    return camera_around(box, corners_of(box), looking_along(view, fov_y_deg), aspect);
}

Camera framing_camera(const Box& box, const Camera& looking, glm::dvec2 size) {
    return camera_around(box, corners_of(box), looking, size);
}

Camera framing_camera(const Scene& scene, const Camera& looking) {
    const Box box = bounds_of_frames(scene);
    return camera_around(box, corners_to_show(scene, box), looking, glm::dvec2(scene.settings.size));
}

Camera framing_camera(const Scene& scene, View view, double fov_y_deg) {
    return framing_camera(scene, looking_along(view, fov_y_deg));
}

bool has_pixel_grid(const Camera& camera) {
    const glm::dmat3 basis = camera_basis(camera);
    const auto is_axis = [](glm::dvec3 v) { return glm::abs(v) == glm::round(glm::abs(v)); };
    return camera.projection == Projection::orthographic && is_axis(basis[0]) && is_axis(basis[1]) &&
           camera.pixels_per_voxel == std::round(camera.pixels_per_voxel);
}

Camera on_pixel_grid(Camera camera, glm::dvec2 size) {
    if (!has_pixel_grid(camera)) return camera;
    const glm::dmat3 basis = camera_basis(camera);
    for (int axis = 0; axis < 2; ++axis) {
        const double border =
            glm::dot(camera.position, basis[axis]) * camera.pixels_per_voxel - size[axis] / 2.0;
        camera.position += (std::round(border) - border) / camera.pixels_per_voxel * basis[axis];
    }
    return camera;
}

glm::ivec2 sprite_size(const Scene& scene, const Camera& looking) {
    const Box box = bounds_of_frames(scene);
    if (box.empty()) return glm::ivec2(glm::max(glm::dvec2(looking.pixels_per_voxel), 1.0));
    const Extent extent = extent_of(corners_to_show(scene, box), camera_basis(looking));
    const glm::dvec2 covered = looking.pixels_per_voxel * glm::dvec2(extent.high - extent.low);
    const glm::dvec2 size = glm::max(glm::ceil(covered - kPixelRounding), 1.0);
    if (size.x > kMaxSpriteSide || size.y > kMaxSpriteSide)
        throw Error(ExitCode::input_refused,
                    fmt::format("a picture of the whole scene with {} pixels per voxel is {}x{}, over the "
                                "limit of {} on a side",
                                looking.pixels_per_voxel, size.x, size.y, kMaxSpriteSide));
    return glm::ivec2(size);
}

Camera default_camera(const Box& box, double aspect) {
    return framing_camera(box, View::three_quarter, aspect);
}

Camera camera_of(const Scene& scene) {
    if (scene.camera) return *scene.camera;
    return framing_camera(scene, View::three_quarter, scene.framing_fov_y_deg);
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
