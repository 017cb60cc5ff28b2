#pragma once

// Structures of one world on the device, in buffers of their own.

#include <optional>
#include <string>

#include "base/stopwatch.h"
#include "record/recording.h"
#include "vk/executor.h"
#include "world/structure_bytes.h"

namespace voxilux {

// What builds a structure: one CPU thread, the device, or both, to compare the results to the bit.
enum class Builder : std::uint8_t { cpu, device, both };

struct PlacedStructure {
    Traversal traversal;
    StructureBytes bytes;
    bool have_texels = false;  // shaders read them as texels
    glm::ivec3 chunks{0};
    std::optional<double> cpu_build;  // seconds of build_march_world
    std::optional<Seconds>
        device_build;    // from the voxels to the structure on the device, compilation excluded
    std::string reason;  // why it is not on the device; empty when it is
};

// Builds a structure of the world and puts it into persistent buffers. Throws InternalError when both
// builders differ in a bit. A structure that the device cannot hold gets a reason instead, before it is built
// where its size is certain.
[[nodiscard]] PlacedStructure place_structure(const VoxelWorld& world, Traversal traversal, Builder builder,
                                              const DeviceLimits& limits, Executor& executor);

// Declares the buffers of a structure in a recording and lets a dispatch march through it.
void point_to_structure(const PlacedStructure& structure, Recording& recording, Dispatch& dispatch);

}  // namespace voxilux
