#pragma once

// How input moves the camera: pure geometry.

#include <optional>

#include <glm/glm.hpp>

#include "scene/scene.h"
#include "scene/scene_bounds.h"
#include "scene/scene_camera.h"

namespace voxilux {

// A camera, and the point that it orbits.
struct ViewPoint {
    Camera camera;
    glm::dvec3 centre{0.0};
};

// The scene as a window shows it: with its sky behind it, and so with a ground that is seen.
[[nodiscard]] Scene window_scene(Scene scene);

[[nodiscard]] bool is_same_view(const Camera& a, const Camera& b);

// The camera with the centre of `box` in front of it.
[[nodiscard]] ViewPoint view_of(const Camera& camera, const Box& box);

// A ray of the scene; the direction has length 1.
struct ViewRay {
    glm::dvec3 start{0.0};
    glm::dvec3 direction{0.0};
};

// The ray of a perspective or orthographic camera through a place of a picture of `size` pixels.
[[nodiscard]] ViewRay ray_through(const Camera& camera, glm::dvec2 place, glm::dvec2 size);

// Where a point of the scene appears in such a picture; empty for one behind the camera.
[[nodiscard]] std::optional<glm::dvec2> place_of(const Camera& camera, glm::dvec3 point, glm::dvec2 size);

// Orbits the centre: columns turn the camera to the side, rows up and down.
[[nodiscard]] ViewPoint orbited(const ViewPoint& view, glm::dvec2 pixels, glm::dvec2 size);
// Shifts camera and centre so that the centre follows the pointer.
[[nodiscard]] ViewPoint panned(const ViewPoint& view, glm::dvec2 pixels, glm::dvec2 size);
// Moves nearer by steps of the wheel. What is under the pointer stays there.
[[nodiscard]] ViewPoint zoomed(const ViewPoint& view, double steps, glm::dvec2 place, glm::dvec2 size);
// Turns the camera about its own position.
[[nodiscard]] ViewPoint looked(const ViewPoint& view, glm::dvec2 pixels, glm::dvec2 size);
// Changes a perspective to parallel rays, and anything else to a perspective. The plane through the centre
// keeps its size in the picture.
[[nodiscard]] ViewPoint with_other_projection(const ViewPoint& view, const Box& box, glm::dvec2 size);
// Moves an orthographic camera so far back that it sees all of the box, however it orbits the centre.
[[nodiscard]] ViewPoint stepped_back(const ViewPoint& view, const Box& box);
// Moves along the camera's axes (right, up, forward), in voxels.
[[nodiscard]] ViewPoint flown(const ViewPoint& view, glm::dvec3 way);

}  // namespace voxilux
