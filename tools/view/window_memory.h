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

// Nothing for an empty name or an absent file. A damaged one is ignored, which one line on standard error
// says.
[[nodiscard]] WindowMemory read_memory(const std::filesystem::path& file);

// Under a temporary name first; nothing for an empty name. What cannot be written is said likewise.
void write_memory(const std::filesystem::path& file, const WindowMemory& memory);

// A file that was shown becomes the newest.
void add_recent(const std::filesystem::path& input, WindowMemory& memory);

// What could be shown next: the recent files but the newest, and the other scenes in the folder of that.
[[nodiscard]] std::vector<std::string> files_to_open(const WindowMemory& memory);

}  // namespace voxilux
