#include "voxelizer/mesh_notes.h"

#include <fmt/format.h>

namespace voxilux {
namespace {

std::string shown(const std::string& text, std::size_t longest) {
    std::string result = text.substr(0, longest);
    for (char& c : result) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    }
    return text.size() > longest ? result + "..." : result;
}

}  // namespace

std::vector<std::string> note_lines(const MeshNotes& notes) {
    std::vector<std::string> lines;
    for (const auto& [text, count] : notes) {
        if (lines.size() == kMostNoteLines) {
            lines.push_back(fmt::format("and {} others", notes.size() - kMostNoteLines));
            break;
        }
        lines.push_back(count == 1 ? one_line(text) : fmt::format("{} ({} times)", one_line(text), count));
    }
    return lines;
}

std::string one_line(const std::string& text) {
    constexpr std::size_t kLongest = 400;
    return shown(text, kLongest);
}

std::string quoted_name(const std::string& name) {
    constexpr std::size_t kLongest = 80;
    return fmt::format("'{}'", shown(name, kLongest));
}

}  // namespace voxilux
