#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace voxilux {

// What the window remembers from one start to the next.
struct WindowMemory {
    glm::ivec2 size{0};  // pixels; 0: unknown
    double frame_ms = 33.0;
    std::vector<std::string> recent;  // files, the newest first
};

// Where it is kept: $XDG_STATE_HOME/voxilux/window.json or ~/.local/state/voxilux/window.json; empty without
// either.
[[nodiscard]] std::filesystem::path window_memory_file();

// Returns defaults for an empty name or an absent file. A damaged file is ignored with one line on standard
// error.
[[nodiscard]] WindowMemory read_memory(const std::filesystem::path& file);

// Replaces the file as a whole; does nothing for an empty name. An error becomes one line on standard error.
void write_memory(const std::filesystem::path& file, const WindowMemory& memory);

// Makes a file that was shown the newest.
void add_recent(const std::filesystem::path& input, WindowMemory& memory);

// Files to offer next: the recent ones except the newest, and the other scenes in the folder of the newest.
[[nodiscard]] std::vector<std::string> files_to_open(const WindowMemory& memory);

}  // namespace voxilux
