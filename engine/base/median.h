#pragma once

#include <algorithm>
#include <vector>

#include "base/assert.h"

namespace voxilux {

// The median; of an even count the mean of the two in the middle. Needs a value (asserted).
[[nodiscard]] inline double median(std::vector<double> values) {
    VX_ASSERT(!values.empty());
    std::ranges::sort(values);
    return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

}  // namespace voxilux
