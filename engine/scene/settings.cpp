#include "scene/settings.h"

#include <cmath>

#include <fmt/format.h>

namespace voxilux {

bool Range::holds(double value) const {
    return std::isfinite(value) && (open_low ? value > low : value >= low) &&
           (open_high ? value < high : value <= high);
}

std::string to_string(Range range) {
    return fmt::format("{}{}, {}{}", range.open_low ? '(' : '[', range.low, range.high,
                       range.open_high ? ')' : ']');
}

}  // namespace voxilux
