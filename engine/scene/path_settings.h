#pragma once

#include <optional>

namespace voxilux {

// Light that paths from the camera find, in place of photons.
struct PathSettings {
    std::optional<bool> indirect;  // light between surfaces; absent: the plan chooses
    std::optional<bool> caustics;  // light of sun and emitters by mirrors and glass; likewise
    bool plain = false;            // paths meet emitters by chance alone, technique `reference`

    bool operator==(const PathSettings&) const = default;
};

}  // namespace voxilux
