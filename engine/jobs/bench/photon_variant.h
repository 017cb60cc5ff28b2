#pragma once

// The ways of tracing photons that `bench photons` compares.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scene/photon_settings.h"

namespace voxilux {

struct PhotonVariant {
    std::string name;
    bool scatter = false;
    bool classic = false;
    bool roulette = true;
    std::uint32_t slowness = 1;  // it takes so many times fewer iterations
};

// The default first, then the others with one option changed.
[[nodiscard]] const std::vector<PhotonVariant>& photon_variants();

// The variants of these names, each once; all of them for no name. Throws Error(usage) for a name that does
// not exist.
[[nodiscard]] std::vector<PhotonVariant> photon_variants_named(std::span<const std::string> names);

// The settings with the options of a variant.
[[nodiscard]] PhotonSettings settings_of(const PhotonVariant& variant, PhotonSettings settings);

// Iterations of a variant where the default takes `iterations`; at least one.
[[nodiscard]] std::uint32_t iterations_of(const PhotonVariant& variant, std::uint32_t iterations);

}  // namespace voxilux
