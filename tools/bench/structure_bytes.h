#pragma once

#include <cstdint>

#include "world/march_world.h"

namespace voxilux {

// Bytes of the three arrays of a structure.
struct StructureBytes {
    std::uint64_t roots = 0;
    std::uint64_t nodes = 0;
    std::uint64_t leaves = 0;
};

[[nodiscard]] StructureBytes bytes_of(const MarchWorld& built);

// What a structure of the world takes at least, without building it: its dense grid exactly, and its leaves
// exactly when no two bricks share them. Costs a look at every brick.
[[nodiscard]] StructureBytes least_bytes(const VoxelWorld& world, Traversal traversal);

}  // namespace voxilux
