#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace voxilux {

// Time on the device of all dispatches of one label. Zero when the device has no timestamps.
struct PassTime {
    std::string label;
    std::uint32_t count = 0;
    double ms = 0.0;      // sum
    double max_ms = 0.0;  // longest single dispatch
};

// Adds times label by label; new labels are appended.
void add_times(std::vector<PassTime>& sum, std::span<const PassTime> more);

}  // namespace voxilux
