#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "base/error.h"
#include "scene/vox_file.h"

namespace voxilux {

// The file, or the first broken rule and its byte offset. Checks all that the other vox_* functions rely on.
// Memory: at most 64 MiB + 64 bytes per byte of the file, whatever it holds; time: linear but for sorting
// node ids.
[[nodiscard]] Result<VoxFile> read_vox(std::span<const std::byte> bytes);

// read_vox of a file on disk. Throws Error(input_refused) with its name.
[[nodiscard]] VoxFile load_vox(const std::filesystem::path& path);

}  // namespace voxilux
