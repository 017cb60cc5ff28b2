#pragma once

#include <optional>
#include <string>

#include "scene/scene_camera.h"

namespace voxilux {

// What --camera names: a side, or a camera that the file has saved.
struct CameraChoice {
    std::optional<View> side;
    std::string name;  // as it was written
};

}  // namespace voxilux
