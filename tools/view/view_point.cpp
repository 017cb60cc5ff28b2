#include "view/view_point.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace voxilux {
namespace {

constexpr double kDegreesPerWindow = 360.0;  // of a drag across the height of the window
constexpr double kMaxPitchDeg = 90.0;
constexpr double kZoomPerStep = 0.85;
constexpr double kMinDistance = 0.5;  // voxels, from the centre

// Pixels of the height per unit of the picture plane at distance 1.
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

}  // namespace

ViewPoint view_of(const Camera& camera, const Box& box) {
    const glm::dvec3 middle = 0.5 * (glm::dvec3(box.lo) + glm::dvec3(box.hi));
    const glm::dvec3 forward = forward_of(camera);
    const double ahead = glm::dot(middle - camera.position, forward);
    return {camera, camera.position + forward * std::max(ahead, 16.0)};
}

glm::dvec3 direction_through(const Camera& camera, glm::dvec2 place, glm::dvec2 size) {
    const glm::dmat3 basis = camera_basis(camera);
    const glm::dvec2 offset = (place - 0.5 * size) / pixels_per_tangent(camera, size);
    return glm::normalize(basis[2] + basis[0] * offset.x - basis[1] * offset.y);
}

std::optional<glm::dvec2> place_of(const Camera& camera, glm::dvec3 point, glm::dvec2 size) {
    constexpr double kNearest = 1e-3;  // voxels: nearer points lie far outside any picture
    const glm::dvec3 seen = glm::transpose(camera_basis(camera)) * (point - camera.position);
    if (seen.z < kNearest) return std::nullopt;
    return 0.5 * size + glm::dvec2(seen.x, -seen.y) * (pixels_per_tangent(camera, size) / seen.z);
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
    const double depth = std::max(glm::dot(view.centre - view.camera.position, basis[2]), kMinDistance);
    const double unit = depth / pixels_per_tangent(view.camera, size);
    const glm::dvec3 shift = unit * (basis[1] * pixels.y - basis[0] * pixels.x);
    ViewPoint next = view;
    next.camera.position += shift;
    next.centre += shift;
    return next;
}

ViewPoint zoomed(const ViewPoint& view, double steps, glm::dvec2 place, glm::dvec2 size) {
    const double distance = glm::length(view.centre - view.camera.position);
    const double wanted = std::max(distance * std::pow(kZoomPerStep, steps), kMinDistance);
    const glm::dvec3 way = direction_through(view.camera, place, size) * (distance - wanted);
    ViewPoint next = view;
    next.camera.position += way;
    // The centre stays as far ahead as it is now.
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
    const glm::dvec3 shift = camera_basis(view.camera) * way;
    ViewPoint next = view;
    next.camera.position += shift;
    next.centre += shift;
    return next;
}

}  // namespace voxilux
