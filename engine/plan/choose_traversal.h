#pragma once

#include <optional>
#include <string>

#include "plan/device_limits.h"
#include "world/structure_bytes.h"

namespace voxilux {

struct TraversalChoice {
    Traversal traversal = Traversal::wide;
    std::string reason;  // one clause, shown to the user

    bool operator==(const TraversalChoice&) const = default;
};

// The user's traversal, or the fastest for a world of this size whose structure is sure to stay within 100 MB
// and the device's limits, else the smallest. A `budget_bytes` other than 0, which is that of the whole
// render, replaces the 100 MB: half of it is for the world.
[[nodiscard]] TraversalChoice choose_traversal(const WorldCensus& census, std::optional<Traversal> request,
                                               std::uint64_t budget_bytes, const DeviceLimits& limits);

}  // namespace voxilux
