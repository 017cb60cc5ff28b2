#pragma once

// What is said about one file: lines for people, an object for programs.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "scene/vox_file.h"

namespace voxilux {

struct FileFacts {
    std::string text;
    nlohmann::json json;
};

// What is in a .vox file, what a scene file sets up (facts, lights, camera, settings), or the size, channels
// with their ranges and text attributes of an EXR, a checkpoint or a PNG, by the file extension. Throws
// Error(input_refused).
[[nodiscard]] FileFacts file_facts(const std::filesystem::path& path);

// The same for the voxels of a file in another format; `path` names it.
[[nodiscard]] FileFacts vox_file_facts(const VoxFile& file, const std::filesystem::path& path);

}  // namespace voxilux
