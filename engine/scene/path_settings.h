#pragma once

namespace voxilux {

// What paths of light from the camera find, in place of photons.
struct PathSettings {
    bool indirect = false;  // light between surfaces
    bool caustics = false;  // light by way of mirrors and glass alone
    bool plain = false;     // paths meet emitters by chance alone, technique `reference`

    bool operator==(const PathSettings&) const = default;
};

}  // namespace voxilux
