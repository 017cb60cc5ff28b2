#include "voxelizer/mesh_notes.h"

#include <fmt/format.h>

#include "base/printable.h"

namespace voxilux {

std::vector<std::string> note_lines(const MeshNotes& notes) {
    std::vector<std::string> lines;
    for (const auto& [text, count] : notes) {
        if (lines.size() == kMaxNoteLines) {
            lines.push_back(fmt::format("and {} others", notes.size() - kMaxNoteLines));
            break;
        }
        lines.push_back(count == 1 ? printable(text) : fmt::format("{} ({} times)", printable(text), count));
    }
    return lines;
}

}  // namespace voxilux
