#pragma once

// Where results go.

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace voxilux {

// Whether the file's ending is `ending` (".exr") in small or capital letters.
[[nodiscard]] bool has_ending(const std::filesystem::path& file, std::string_view ending);

// The name of a frame's file: "a/b.exr" gives "a/b.0007.exr". At least four digits, as many as `last` has.
[[nodiscard]] std::filesystem::path numbered(const std::filesystem::path& file, std::int64_t frame,
                                             std::int64_t last);

// Throws Error(cannot_write) for a file that could not be written later: a folder of that name, a folder that
// is absent or may not be written into. Nothing for "" and "-". Finding out before the work is kinder than
// after it.
void check_writable(const std::filesystem::path& file);

// Writes JSON to a file, or to standard output for "-". Nothing for an empty name.
void write_json(const std::string& file, const nlohmann::ordered_json& json);

}  // namespace voxilux
