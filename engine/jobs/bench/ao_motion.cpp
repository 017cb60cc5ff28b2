#include "jobs/bench/ao_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "jobs/bench/item_named.h"
#include "scene/scene_camera.h"

namespace voxilux {
namespace {

constexpr double kRadian = std::numbers::pi / 180.0;  // per degree
constexpr double kSteepestPitchDeg = 80.0;
constexpr std::array<std::string_view, kMotions.size()> kNames = {"still", "pan", "walk", "floor"};

}  // namespace

std::string_view name_of(Motion motion) {
    return kNames[static_cast<std::size_t>(motion)];
}

Motion motion_named(std::string_view name) {
    return item_named("motion", name, kMotions, [](Motion motion) { return name_of(motion); });
}

Camera moved_camera(const Camera& start, Motion motion, int frame, int height) {
    Camera camera = start;
    const double moves = frame - 1;
    if (motion == Motion::pan) {
        const double pixel = 2.0 * std::tan(start.fov_y_deg * kRadian / 2.0) / height;
        const double pitch_deg = std::clamp(start.pitch_deg, -kSteepestPitchDeg, kSteepestPitchDeg);
        camera.yaw_deg += moves * std::atan(pixel) / std::cos(pitch_deg * kRadian) / kRadian;
    }
    if (motion == Motion::walk) camera.position += moves * kWalkStep * camera_basis(start)[0];
    return camera;
}

}  // namespace voxilux
