#pragma once

// The C++ side of shaders/shared/march.h: the march reads a Naadf where the shader reads its buffers.

#include "world/naadf.h"

namespace voxilux::gpu {

inline std::uint32_t load_chunk(const Naadf& naadf, std::uint32_t i) {
    return naadf.chunks[i];
}
inline std::uint32_t load_brick(const Naadf& naadf, std::uint32_t i) {
    return naadf.bricks[i];
}
inline std::uint32_t load_voxel_word(const Naadf& naadf, std::uint32_t i) {
    return naadf.voxels[i];
}

}  // namespace voxilux::gpu

#define VX_WORLD_PARAM const ::voxilux::Naadf &naadf,
#define VX_WORLD_ARG naadf,
#include "shared/march.h"
#undef VX_WORLD_PARAM
#undef VX_WORLD_ARG
