#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "world/voxel_world.h"

namespace voxilux {

// Nested anisotropic distance fields of a world, laid out as the shaders read them
// (shaders/shared/naadf_cell.h).
struct Naadf {
    glm::ivec3 origin{0};               // scene cell of local cell 0
    glm::ivec3 chunks_size{1};          // chunks per axis
    std::vector<std::uint32_t> chunks;  // dense, x fastest
    std::vector<std::uint32_t> bricks;  // 64 per mixed chunk
    std::vector<std::uint32_t> voxels;  // 32 words (64 voxels of 16 bits) per distinct mixed brick

    [[nodiscard]] glm::ivec3 size() const { return chunks_size * 16; }
    [[nodiscard]] std::uint64_t size_bytes() const {
        return 4 * (chunks.size() + bricks.size() + voxels.size());
    }
};

// Builds the structure on the CPU. Readable rather than fast: it is the oracle for every other builder. Equal
// bricks are stored once.
[[nodiscard]] Naadf build_naadf(const VoxelWorld& world);

}  // namespace voxilux
