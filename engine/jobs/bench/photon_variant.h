#pragma once

// The variants of photon tracing that `bench photons` compares.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scene/photon_settings.h"

namespace voxilux {

struct PhotonVariant {
    std::string name;
    bool scatter = false;
    bool classic = false;
    bool roulette = true;
    std::uint32_t slowness = 1;  // divides the number of iterations

    bool operator==(const PhotonVariant&) const = default;
};

// The default first, then variants with one option changed.
[[nodiscard]] const std::vector<PhotonVariant>& photon_variants();

// The variant of that name; Error(usage) with the known names when there is none.
[[nodiscard]] const PhotonVariant& photon_variant_named(std::string_view name);

// The settings with the options of a variant.
[[nodiscard]] PhotonSettings settings_of(const PhotonVariant& variant, PhotonSettings settings);

// Iterations of a variant where the default takes `iterations`; at least one.
[[nodiscard]] std::uint32_t iterations_of(const PhotonVariant& variant, std::uint32_t iterations);

}  // namespace voxilux
