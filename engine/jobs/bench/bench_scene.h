#pragma once

// The scenes of the benchmarks.

#include <cstdint>
#include <filesystem>
#include <string>

#include "scene/scene.h"
#include "world/voxel_world.h"

namespace voxilux {

// A world and its camera. The extent is the longest axis of the world in voxels.
struct BenchScene {
    std::string name;
    int extent = 0;
    VoxelWorld world;
    Camera camera;  // in scene space
};

inline constexpr int kMinExtent = 32;
inline constexpr int kMaxExtent = 4096;

// Hills, with 24 hollow boxes with windows on them and 30 hollow spheres above, all in proportion to `extent`
// (in whole chunks of 16). Walls are a few voxels thick, and only their voxels are visited. Seen from above,
// with sky in the image. 24 materials.
[[nodiscard]] BenchScene procedural_scene(int extent, std::uint32_t seed);

// The voxels of a .vox or scene file and its camera; `size` is that of the image, pixels. Throws
// Error(input_refused) as load_scene, and when there is no voxel.
[[nodiscard]] BenchScene file_scene(const std::filesystem::path& file, glm::ivec2 size);

}  // namespace voxilux
