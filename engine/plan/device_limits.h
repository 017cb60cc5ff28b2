#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "shared/limits.h"

namespace voxilux {

// What a plan needs to know of the device it plans for. The defaults are those of Mesa lavapipe, so that
// plans can be made and tested with no device.
struct DeviceLimits {
    std::uint64_t max_binding_bytes = std::uint64_t{128} << 20;   // one storage buffer seen by a shader
    std::uint64_t max_allocation_bytes = std::uint64_t{2} << 30;  // one buffer
    std::array<std::uint32_t, 3> max_groups = {65535, 65535, 65535};
    std::uint32_t max_push_bytes = 128;
    std::uint32_t max_texels = std::uint32_t{1} << 27;  // of one buffer
    std::uint32_t subgroup_size = 8;                    // on CPUs of all subgroups, on others the largest
    bool is_cpu = true;
    std::string name = "lavapipe";

    bool operator==(const DeviceLimits&) const = default;
};

// Most bytes of one array of a world: shaders reach it by its address, so no binding limits it.
[[nodiscard]] inline std::uint64_t max_world_array_bytes(const DeviceLimits& limits) {
    return std::min(limits.max_allocation_bytes, 4 * (std::uint64_t{gpu::kLastWorldWord} + 1));
}

// Whether shaders read a world's arrays, of which the largest has so many bytes, as texels of one word.
// Software devices load those faster than what a pointer points to; on others no difference is known.
[[nodiscard]] inline bool loads_texels(const DeviceLimits& limits, std::uint64_t largest_bytes) {
    return limits.is_cpu && largest_bytes / 4 <= limits.max_texels;
}

}  // namespace voxilux
