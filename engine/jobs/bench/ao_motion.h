#pragma once

// How the camera moves in `bench ao`.

#include <array>
#include <cstdint>
#include <string_view>

#include "scene/scene.h"

namespace voxilux {

// still: it does not move. pan: it turns about the vertical so that the centre of the image moves by one
// pixel a frame. walk: it moves to its right, kWalkStep a frame. floor: it stands still and takes so many
// rays that the remaining error is the bias of the cells.
enum class Motion : std::uint8_t { still, pan, walk, floor };
inline constexpr std::array kMotions = {Motion::still, Motion::pan, Motion::walk, Motion::floor};
inline constexpr double kWalkStep = 0.3;  // voxels

// "still", "pan", "walk", "floor".
[[nodiscard]] std::string_view name_of(Motion motion);

// The motion of that name; Error(usage) with the known names when there is none.
[[nodiscard]] Motion motion_named(std::string_view name);

// The camera of frame 1, 2, ... of a motion that starts at `start`; `height` is that of the image, pixels.
// Looking straight up or down, a pan does not move the centre: it turns as at 80 degrees.
[[nodiscard]] Camera moved_camera(const Camera& start, Motion motion, int frame, int height);

}  // namespace voxilux
