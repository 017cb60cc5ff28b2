#pragma once

#include <cstdint>
#include <optional>

namespace voxilux {

// How photons find indirect light and caustics; one sample of a pixel is one iteration.
struct PhotonSettings {
    static constexpr std::int64_t kMaxCount = std::int64_t{1} << 24;

    std::uint32_t count = 0;       // per iteration; 0: as many as the image has pixels
    std::optional<double> radius;  // of the first iteration, voxels; absent: from a pilot
    double alpha = 2.0 / 3.0;      // exponent of the radius reduction; 1: the radius is constant
    bool scatter = false;          // splatting: photons add themselves to visible points
    bool classic = false;          // per-pixel radii (Hachisuka 2008), which shrink as photons arrive
    bool roulette = true;          // ends paths by chance, without bias; false: after `depth` surfaces
    std::uint32_t depth = 24;      // surfaces on a path without roulette
    bool aim = true;               // those of caustics alone start towards mirrors and glass
    bool caustics = true;          // false: nothing finds them, technique `none`
    bool indirect = true;          // likewise indirect light

    bool operator==(const PhotonSettings&) const = default;
};

}  // namespace voxilux
