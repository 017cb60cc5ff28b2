#pragma once

#include <cstdint>
#include <span>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace voxilux {

// The camera of a path at `frame`: exactly that of a key at the key's frame, the first or the last one beyond
// them. `linear` goes straight from key to key. `smooth` has no corner (C1): cubics whose slope at a key is
// that of the parabola through it and its neighbours (Overhauser 1968; de Boor 1978, "cubic Bessel"). Yaw
// turns the short way round. Where every key has a look_at, that point moves likewise and sets the direction.
[[nodiscard]] Camera camera_on_path(std::span<const CameraKey> keys, CameraPath path, std::int64_t frame);

// Degrees that a turntable has turned by at `frame`.
[[nodiscard]] double angle_of(const Turntable& turntable, std::int64_t frame);

// The camera of a turntable at `frame`, `rest` being that of angle 0 and `axis` x and y of the vertical line
// it goes round. Its distance from the axis, height and pitch are the same in all frames.
[[nodiscard]] Camera camera_on_turntable(const Turntable& turntable, const Camera& rest, glm::dvec2 axis,
                                         std::int64_t frame);

// The sun of a turntable at `frame`.
[[nodiscard]] Sun sun_on_turntable(const Turntable& turntable, const Sun& rest, std::int64_t frame);

// The azimuth at `frame` of what goes round with the sun, `rest_deg` being that of angle 0.
[[nodiscard]] float azimuth_on_turntable(const Turntable& turntable, float rest_deg, std::int64_t frame);

}  // namespace voxilux
