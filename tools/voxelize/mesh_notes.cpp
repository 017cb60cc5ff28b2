#include "voxelize/mesh_notes.h"

#include <fmt/format.h>

namespace voxilux {

std::vector<std::string> note_lines(const MeshNotes& notes) {
    std::vector<std::string> lines;
    for (const auto& [text, count] : notes) {
        if (lines.size() == kMostNoteLines) {
            lines.push_back(fmt::format("and {} others", notes.size() - kMostNoteLines));
            break;
        }
        lines.push_back(count == 1 ? text : fmt::format("{} ({} times)", text, count));
    }
    return lines;
}

std::string quoted_name(const std::string& name) {
    constexpr std::size_t kLongest = 80;
    std::string shown = name.substr(0, kLongest);
    for (char& c : shown) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    }
    return fmt::format("'{}{}'", shown, name.size() > kLongest ? "..." : "");
}

}  // namespace voxilux
