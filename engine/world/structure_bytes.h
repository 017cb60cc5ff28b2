#pragma once

#include <cstdint>

#include "world/march_world.h"

namespace voxilux {

// What decides how large the structures of a world are. A cell is mixed unless it is empty or of one
// material.
struct WorldCensus {
    glm::ivec3 chunks{0};
    std::uint64_t voxels = 0;
    std::uint64_t mixed_bricks = 0;   // 4^3
    std::uint64_t mixed_bricks8 = 0;  // 8^3
    std::uint64_t mixed_chunks = 0;   // 16^3

    bool operator==(const WorldCensus&) const = default;
};

// Looks at every brick once.
[[nodiscard]] WorldCensus take_census(const VoxelWorld& world);

// Bytes of the three arrays of a structure.
struct StructureBytes {
    std::uint64_t roots = 0;
    std::uint64_t nodes = 0;
    std::uint64_t leaves = 0;

    bool operator==(const StructureBytes&) const = default;

    [[nodiscard]] std::uint64_t total() const { return roots + nodes + leaves; }
};

[[nodiscard]] StructureBytes bytes_of(const MarchWorld& built);

// What bytes_of will return once the structure is built; an upper bound where equal bricks are stored once.
[[nodiscard]] StructureBytes predict_bytes(const WorldCensus& census, Traversal traversal);

}  // namespace voxilux
