#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "scene/scene.h"
#include "scene/scene_bounds.h"

namespace voxilux {

// Where a framing camera looks from. `front` is the -y side of a model, `right` its +x side.
enum class View : std::uint8_t { three_quarter, front, back, left, right, top, bottom, iso };

// The vertical field of view of a framing camera unless the scene sets another.
inline constexpr double kDefaultFovYDeg = 45.0;

// The fraction of half the image, on each axis, that a framed box leaves free.
inline constexpr double kFrameMargin = 0.05;

// Voxels between a framing camera and the plane through the nearest corner: a corner at depth 0 has no place
// in the image. It matters only where the field of view is wider than the corner of the box, beyond about 90
// degrees.
inline constexpr double kFrameClearance = 0.125;

// Voxels between the nearest corner and the plane that the rays of an orthographic framing camera start from.
inline constexpr double kParallelClearance = 1.0;

// The camera that looks along `view` from the nearest point at which the whole box is inside the image less
// its margin. Exact: the box touches the margin on two opposite sides (but see kFrameClearance). `aspect` is
// width / height. An empty box gives a camera that looks at the origin from 64 voxels away.
[[nodiscard]] Camera framing_camera(const Box& box, View view, double aspect,
                                    double fov_y_deg = kDefaultFovYDeg);

// The framing camera of a scene for its image size: around bounds_of_frames; on a turntable, around all that
// these cover in a turn.
[[nodiscard]] Camera framing_camera(const Scene& scene, View view, double fov_y_deg = kDefaultFovYDeg);

// The direction of a view, with a field of view.
[[nodiscard]] Camera looking_along(View view, double fov_y_deg = kDefaultFovYDeg);

// The same for the direction and the lens of any camera; `size` is the image's, pixels. An orthographic one
// without pixels_per_voxel gets as many as leave the margin free. A panorama stands where a perspective
// camera of at most 90 degrees would.
[[nodiscard]] Camera framing_camera(const Box& box, const Camera& looking, glm::dvec2 size);
[[nodiscard]] Camera framing_camera(const Scene& scene, const Camera& looking);

// Whether borders of voxels can lie on borders of pixels: parallel rays along an axis, whole pixels per
// voxel.
[[nodiscard]] bool has_pixel_grid(const Camera& camera);

// Such a camera, moved by at most half a pixel so that they do; any other camera unchanged.
[[nodiscard]] Camera on_pixel_grid(Camera camera, glm::dvec2 size);

// The size of the smallest image that shows the whole scene at the pixels_per_voxel of `looking`. Throws
// Error(input_refused) where it is larger than images can be.
[[nodiscard]] glm::ivec2 sprite_size(const Scene& scene, const Camera& looking);

// The view of a scene that names none: three-quarter from above, the front and the right side in sight.
[[nodiscard]] Camera default_camera(const Box& box, double aspect);

// The scene's own camera, or the default one, framing_camera from the three-quarter view.
[[nodiscard]] Camera camera_of(const Scene& scene);

// Columns right, up, forward: orthonormal, right x up = -forward, right is horizontal. Straight up and down
// are the limit of the pitch at constant yaw: looking down with yaw 90, +y is up in the image.
[[nodiscard]] glm::dmat3 camera_basis(const Camera& camera);

// Yaw and pitch of the direction `forward` (any length but zero), the yaw of a vertical one being 90.
struct YawPitch {
    double yaw_deg = 0.0;
    double pitch_deg = 0.0;
};
[[nodiscard]] YawPitch yaw_pitch_of(glm::dvec3 forward);

}  // namespace voxilux
