#include "jobs/frame_list.h"

#include <algorithm>

#include <fmt/format.h>

namespace voxilux {

std::filesystem::path numbered(const std::filesystem::path& file, std::int64_t frame, std::int64_t last) {
    const std::size_t digits = std::max<std::size_t>(4, std::to_string(last).size());
    std::filesystem::path name = file.stem();
    name += fmt::format(".{:0{}}", frame, digits);
    name += file.extension();
    return file.parent_path() / name;
}

std::vector<std::string> files_of_frame(const std::vector<std::string>& files, const FrameList& frames,
                                        std::int64_t frame) {
    if (!frames.is_sequence) return files;
    std::vector<std::string> names;
    for (const std::string& file : files)
        names.push_back(numbered(file, frame, frames.last).string());
    return names;
}

}  // namespace voxilux
