#include "view/view_point.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/settings.h"

namespace voxilux {
namespace {

constexpr double kDegreesPerWindow = 360.0;  // for a drag across the height of the window
constexpr double kMaxPitchDeg = 90.0;
constexpr double kZoomPerStep = 0.85;
constexpr double kMinDistance = 0.5;  // voxels, from the centre
constexpr double kMinScale = 1e-3;    // pixels per voxel

// Pixels of the image height per unit of the image plane at distance 1.
double pixels_per_tangent(const Camera& camera, glm::dvec2 size) {
    return size.y / (2.0 * std::tan(camera.fov_y_deg * std::numbers::pi / 360.0));
}

glm::dvec3 forward_of(const Camera& camera) {
    return camera_basis(camera)[2];
}

Camera turned(Camera camera, glm::dvec2 degrees) {
    camera.yaw_deg += degrees.x;
    camera.pitch_deg = std::clamp(camera.pitch_deg + degrees.y, -kMaxPitchDeg, kMaxPitchDeg);
    return camera;
}

bool is_orthographic(const Camera& camera) {
    return camera.projection == Projection::orthographic;
}

// The vector in the scene from the middle of a picture to a place in it, for pixels one voxel wide.
glm::dvec3 offset_in(const Camera& camera, glm::dvec2 place, glm::dvec2 size) {
    const glm::dmat3 basis = camera_basis(camera);
    const glm::dvec2 pixels = place - 0.5 * size;
    return basis[0] * pixels.x - basis[1] * pixels.y;
}

double depth_of_centre(const ViewPoint& view) {
    return std::max(glm::dot(view.centre - view.camera.position, forward_of(view.camera)), kMinDistance);
}

// Size in pixels of a voxel in the plane through the centre.
double scale_at_centre(const ViewPoint& view, glm::dvec2 size) {
    if (is_orthographic(view.camera)) return view.camera.pixels_per_voxel;
    return pixels_per_tangent(view.camera, size) / depth_of_centre(view);
}

double in_scale_range(double pixels_per_voxel) {
    return std::clamp(pixels_per_voxel, kMinScale, kMaxPixelsPerVoxel);
}

ViewPoint shifted(ViewPoint view, glm::dvec3 shift) {
    view.camera.position += shift;
    view.centre += shift;
    return view;
}

// Scales by steps of the wheel. What is under the pointer stays there.
ViewPoint magnified(ViewPoint view, double steps, glm::dvec2 place, glm::dvec2 size) {
    const double before = view.camera.pixels_per_voxel;
    view.camera.pixels_per_voxel = in_scale_range(before * std::pow(kZoomPerStep, -steps));
    const double shorter = 1.0 / before - 1.0 / view.camera.pixels_per_voxel;
    return shifted(view, offset_in(view.camera, place, size) * shorter);
}

}  // namespace

Scene window_scene(Scene scene) {
    scene.background = {};
    scene.ground.shadow_only = false;
    scene.camera = camera_of(scene);
    return scene;
}

bool is_same_view(const Camera& a, const Camera& b) {
    return a.position == b.position && a.yaw_deg == b.yaw_deg && a.pitch_deg == b.pitch_deg &&
           a.fov_y_deg == b.fov_y_deg && a.projection == b.projection &&
           a.pixels_per_voxel == b.pixels_per_voxel;
}

ViewPoint view_of(const Camera& camera, const Box& box) {
    const glm::dvec3 middle = 0.5 * (glm::dvec3(box.lo) + glm::dvec3(box.hi));
    const glm::dvec3 forward = forward_of(camera);
    const double ahead = glm::dot(middle - camera.position, forward);
    return {camera, camera.position + forward * std::max(ahead, 16.0)};
}

ViewRay ray_through(const Camera& camera, glm::dvec2 place, glm::dvec2 size) {
    const glm::dvec3 offset = offset_in(camera, place, size);
    const glm::dvec3 forward = forward_of(camera);
    if (is_orthographic(camera)) return {camera.position + offset / camera.pixels_per_voxel, forward};
    return {camera.position, glm::normalize(forward + offset / pixels_per_tangent(camera, size))};
}

std::optional<glm::dvec2> place_of(const Camera& camera, glm::dvec3 point, glm::dvec2 size) {
    constexpr double kNearest = 1e-3;  // voxels: nearer points lie far outside any picture
    const glm::dvec3 seen = glm::transpose(camera_basis(camera)) * (point - camera.position);
    if (seen.z < kNearest) return std::nullopt;
    const double scale =
        is_orthographic(camera) ? camera.pixels_per_voxel : pixels_per_tangent(camera, size) / seen.z;
    return 0.5 * size + glm::dvec2(seen.x, -seen.y) * scale;
}

ViewPoint orbited(const ViewPoint& view, glm::dvec2 pixels, glm::dvec2 size) {
    ViewPoint next = view;
    next.camera = turned(view.camera, -pixels * kDegreesPerWindow / size.y);
    const glm::dvec3 before =
        glm::transpose(camera_basis(view.camera)) * (view.camera.position - view.centre);
    next.camera.position = view.centre + camera_basis(next.camera) * before;
    return next;
}

ViewPoint panned(const ViewPoint& view, glm::dvec2 pixels, glm::dvec2 size) {
    const glm::dmat3 basis = camera_basis(view.camera);
    return shifted(view, (basis[1] * pixels.y - basis[0] * pixels.x) / scale_at_centre(view, size));
}

ViewPoint zoomed(const ViewPoint& view, double steps, glm::dvec2 place, glm::dvec2 size) {
    if (is_orthographic(view.camera)) return magnified(view, steps, place, size);
    const double distance = glm::length(view.centre - view.camera.position);
    const double wanted = std::max(distance * std::pow(kZoomPerStep, steps), kMinDistance);
    const glm::dvec3 way = ray_through(view.camera, place, size).direction * (distance - wanted);
    ViewPoint next = view;
    next.camera.position += way;
    // The centre stays at its distance, ahead of the camera.
    next.centre = next.camera.position + glm::normalize(view.centre - view.camera.position) * wanted;
    return next;
}

ViewPoint looked(const ViewPoint& view, glm::dvec2 pixels, glm::dvec2 size) {
    ViewPoint next = view;
    next.camera = turned(view.camera, -pixels * view.camera.fov_y_deg / size.y);
    const double distance = glm::length(view.centre - view.camera.position);
    next.centre = next.camera.position + forward_of(next.camera) * distance;
    return next;
}

ViewPoint flown(const ViewPoint& view, glm::dvec3 way) {
    return shifted(view, camera_basis(view.camera) * way);
}

ViewPoint stepped_back(const ViewPoint& view, const Box& box) {
    ViewPoint next = view;
    if (!is_orthographic(view.camera)) return next;
    const glm::dvec3 size(box.hi - box.lo);
    const glm::dvec3 middle = 0.5 * (glm::dvec3(box.lo) + glm::dvec3(box.hi));
    const double reach = glm::length(middle - view.centre) + glm::length(size);
    const double depth = glm::dot(view.centre - view.camera.position, forward_of(view.camera));
    if (depth < reach) next.camera.position -= forward_of(view.camera) * (reach - depth);
    return next;
}

ViewPoint with_other_projection(const ViewPoint& view, const Box& box, glm::dvec2 size) {
    ViewPoint next = view;
    Camera& camera = next.camera;
    if (camera.projection == Projection::perspective) {
        camera.pixels_per_voxel = in_scale_range(scale_at_centre(view, size));
        camera.projection = Projection::orthographic;
        return stepped_back(next, box);
    }
    camera.projection = Projection::perspective;
    camera.pixels_per_voxel = 0.0;
    camera.fov_y_deg = kDefaultFovYDeg;
    if (is_orthographic(view.camera)) {
        const double distance = pixels_per_tangent(camera, size) / view.camera.pixels_per_voxel;
        camera.position = view.centre - forward_of(camera) * distance;
    }
    return next;
}

}  // namespace voxilux
