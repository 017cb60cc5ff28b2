#pragma once

// What the benchmarks march through.

#include <cstdint>
#include <filesystem>
#include <string>

#include "scene/scene.h"
#include "world/voxel_world.h"

namespace voxilux {

// A world and the camera that looks at it. Its extent is the longest axis of the world in voxels.
struct BenchScene {
    std::string name;
    int extent = 0;
    VoxelWorld world;
    Camera camera;  // in scene space
};

inline constexpr int kMinExtent = 32;
inline constexpr int kMaxExtent = 4096;

// Hills, 24 hollow boxes with windows that stand on them and 30 hollow spheres above, all in proportion to
// `extent` (whole chunks of 16), skins of a few voxels, seen from above with sky in the picture. Only the
// voxels of the skins are visited. 24 materials.
[[nodiscard]] BenchScene procedural_scene(int extent, std::uint32_t seed);

// The voxels of a .vox file or of a scene file and its camera; `size` is that of the picture, in pixels.
// Throws Error(input_refused) as load_scene, and when there is no voxel.
[[nodiscard]] BenchScene file_scene(const std::filesystem::path& file, glm::ivec2 size);

}  // namespace voxilux
