#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace voxilux {

// The frames first, first + step, ... up to last.
struct FrameList {
    std::int64_t first = 0;
    std::int64_t last = 0;
    std::int64_t step = 1;
    bool is_sequence = false;  // file names contain the frame number

    bool operator==(const FrameList&) const = default;
    [[nodiscard]] std::int64_t count() const { return (last - first) / step + 1; }
    [[nodiscard]] std::int64_t at(std::int64_t index) const { return first + index * step; }
};

// The name of a frame's file: "a/b.exr" gives "a/b.0007.exr". At least four digits, as many as `last` has.
[[nodiscard]] std::filesystem::path numbered(const std::filesystem::path& file, std::int64_t frame,
                                             std::int64_t last);

// The file names of a frame's images: the files themselves, or numbered in a frame range.
[[nodiscard]] std::vector<std::string> files_of_frame(const std::vector<std::string>& files,
                                                      const FrameList& frames, std::int64_t frame);

}  // namespace voxilux
