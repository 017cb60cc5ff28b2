#pragma once

#include <cstdint>

namespace voxilux {

// The frames first, first + step, ... up to last.
struct FrameList {
    std::int64_t first = 0;
    std::int64_t last = 0;
    std::int64_t step = 1;
    bool is_sequence = false;  // files carry the number of their frame

    bool operator==(const FrameList&) const = default;
    [[nodiscard]] std::int64_t count() const { return (last - first) / step + 1; }
    [[nodiscard]] std::int64_t at(std::int64_t index) const { return first + index * step; }
};

}  // namespace voxilux
