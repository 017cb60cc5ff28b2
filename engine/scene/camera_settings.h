#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include <glm/glm.hpp>

#include "scene/scene.h"
#include "scene/scene_camera.h"

namespace voxilux {

// What a scene file says of where the camera stands. A direction is a point to look at, or yaw and pitch.
struct CameraPlacement {
    std::optional<glm::dvec3> position;
    std::optional<glm::dvec3> look_at;
    std::optional<double> yaw_deg;
    std::optional<double> pitch_deg;
    double fov_y_deg = kDefaultFovYDeg;
};

inline constexpr std::array<std::string_view, 7> kViewNames{
    "three_quarter", "front", "back", "left", "right", "top", "iso"};  // in the order of View

// [camera], less its keys and its turntable.
struct CameraSettings {
    CameraPlacement placement;
    std::optional<View> preset;
    CameraPath path = CameraPath::smooth;
};

// [[camera.key]]
struct CameraKeySettings {
    std::int64_t frame = 0;
    CameraPlacement placement;
};

}  // namespace voxilux
