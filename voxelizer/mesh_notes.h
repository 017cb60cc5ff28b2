#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace voxilux {

// What a loader dropped or replaced: how often each thing happened, by its message.
using MeshNotes = std::map<std::string, std::size_t>;

// One line per note, in alphabetical order, with the count if it is above 1; after the first kMaxNoteLines, a
// line with the number of the others.
inline constexpr std::size_t kMaxNoteLines = 50;
[[nodiscard]] std::vector<std::string> note_lines(const MeshNotes& notes);

}  // namespace voxilux
