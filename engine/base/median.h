#pragma once

#include <algorithm>
#include <vector>

#include "base/assert.h"

namespace voxilux {

// The median; for an even count, the mean of the two middle values. Needs at least one value (asserted).
[[nodiscard]] inline double median(std::vector<double> values) {
    VX_ASSERT(!values.empty());
    std::ranges::sort(values);
    return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

}  // namespace voxilux
