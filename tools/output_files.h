#pragma once

// Where results go.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace voxilux {

// Whether the file's ending is `ending` (".exr") in small or capital letters.
[[nodiscard]] bool has_ending(const std::filesystem::path& file, std::string_view ending);

// Throws Error(cannot_write) for a file that could not be written later: a folder of that name, a folder that
// is absent or may not be written into. Nothing for "" and "-". Finding out before the work is kinder than
// after it.
void check_writable(const std::filesystem::path& file);

// Writes JSON to a file, or to standard output for "-". Nothing for an empty name.
void write_json(const std::string& file, const nlohmann::ordered_json& json);

}  // namespace voxilux
