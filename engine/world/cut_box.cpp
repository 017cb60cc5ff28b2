#include "world/cut_box.h"

#include "shared/aadf.h"

namespace voxilux {

std::uint32_t cut_distances(std::uint32_t distances, glm::ivec3 cell, const CellBounds& filled) {
    std::uint32_t best = 0;
    float most = 0.0f;  // part of the box that is left
    for (int axis = 0; axis < 3; ++axis) {
        const auto low_direction = static_cast<gpu::uint>(2 * axis);
        const auto low = static_cast<int>(gpu::distance_towards(distances, low_direction));
        const auto high = static_cast<int>(gpu::distance_towards(distances, low_direction + 1));
        const int at = cell[axis];
        if (at + high < filled.low[axis] || at - low >= filled.high[axis]) return distances;
        const bool is_below = at < filled.low[axis];
        if (!is_below && at < filled.high[axis]) continue;  // no cut across this axis parts them
        const int left = is_below ? filled.low[axis] - at - 1 : at - filled.high[axis];
        const float part =
            static_cast<float>(left + 1 + (is_below ? low : high)) / static_cast<float>(low + high + 1);
        if (part <= most) continue;
        most = part;
        const gpu::uint direction = low_direction + (is_below ? 1 : 0);
        const gpu::uint shift = gpu::kFarBits * direction;
        best = (distances & ~(gpu::kDistanceOnes << shift)) | static_cast<gpu::uint>(left) << shift;
    }
    return best;
}

}  // namespace voxilux
