#pragma once

// The march with its entry into the world, on the device and in C++, ray by ray.

#include <string>
#include <vector>

#include "world/march_world.h"
#include "world/world_view.h"

#define VX_WORLD_PARAM const ::voxilux::MarchWorld &march_world,
#define VX_WORLD_ARG march_world,
#define VX_TRAVERSAL static_cast<::voxilux::gpu::uint>(march_world.traversal)
#include "probe/march_functions.h"
#undef VX_WORLD_PARAM
#undef VX_WORLD_ARG
#undef VX_TRAVERSAL

namespace voxilux::test {

// How the device reads the world's arrays.
enum class WorldAccess : std::uint8_t { texels, pointers };

[[nodiscard]] std::vector<gpu::MarchProbe> march_on_device(const MarchWorld& march_world,
                                                           const std::vector<gpu::Ray>& rays,
                                                           WorldAccess access = WorldAccess::texels);

[[nodiscard]] std::vector<gpu::MarchProbe> march_in_cpp(const MarchWorld& march_world,
                                                        const std::vector<gpu::Ray>& rays);

// The ray as C++ initializers, so that a failure can become a fixed case.
[[nodiscard]] std::string print(const gpu::Ray& ray);

}  // namespace voxilux::test
