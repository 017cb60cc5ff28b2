#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "scene/vox_file.h"

namespace voxilux {

// The bytes of a .vox file that MagicaVoxel opens and that read_vox gives back equal but for its warnings.
// Chunks come in MagicaVoxel's order. An RGBA chunk (always 256 colours) is written when the palette is the
// file's own or is not the default one. Throws Error(cannot_write) over the format's 4 GiB.
[[nodiscard]] std::vector<std::byte> write_vox(const VoxFile& file);

// What is needed of a model before its voxels.
struct VoxModelHead {
    glm::ivec3 size{0};  // each side in [1, kVoxMaxSide]
    std::uint64_t voxels = 0;
};

// Writes a .vox file model by model, so that memory holds one model at a time: voxels_of(i) is asked for in
// order and gives as many as models[i] says. All other chunks come from `rest`, whose models are not read. A
// failure leaves no file. Returns the file's bytes. Throws Error(cannot_write), also over 4 GiB.
std::uint64_t write_vox_models(const std::filesystem::path& path, std::span<const VoxModelHead> models,
                               const std::function<std::vector<VoxVoxel>(std::size_t)>& voxels_of,
                               const VoxFile& rest);

}  // namespace voxilux
