#pragma once

// What is said about one file: lines for people, an object for programs.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace voxilux {

struct FileFacts {
    std::string text;
    nlohmann::json json;
};

// The contents of a .vox file as they lie in it. All three throw Error(input_refused).
[[nodiscard]] FileFacts vox_facts(const std::filesystem::path& path);

// What a scene file makes: its facts, lights, camera and settings.
[[nodiscard]] FileFacts scene_facts(const std::filesystem::path& path);

// Size, channels with their ranges, and text attributes of an EXR or a PNG.
[[nodiscard]] FileFacts image_facts(const std::filesystem::path& path);

}  // namespace voxilux
