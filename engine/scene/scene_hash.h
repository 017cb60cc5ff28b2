#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace voxilux {

// XXH3-64 of a little-endian serialisation of everything an image depends on: the same on every machine, and
// the same for scenes that differ only in names and warnings. The hash of an animated scene covers all of its
// frames.
[[nodiscard]] std::uint64_t scene_hash(const Scene& scene);

// The same without the samples per pixel: equal for scenes whose samples may be added up.
[[nodiscard]] std::uint64_t sample_hash(const Scene& scene);

}  // namespace voxilux
