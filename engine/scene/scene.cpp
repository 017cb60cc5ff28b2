#include "scene/scene.h"

#include "scene/angles.h"

namespace voxilux {

glm::vec3 Sun::direction() const {
    return glm::vec3(direction_from_deg(double{azimuth_deg}, double{elevation_deg}));
}

}  // namespace voxilux
