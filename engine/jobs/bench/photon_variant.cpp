#include "jobs/bench/photon_variant.h"

#include <algorithm>

#include "jobs/bench/item_named.h"

namespace voxilux {
const std::vector<PhotonVariant>& photon_variants() {
    static const std::vector<PhotonVariant> variants = {
        {.name = "gather"},
        {.name = "no-roulette", .roulette = false},
        {.name = "classic", .classic = true},
        {.name = "scatter", .scatter = true, .slowness = 16},
    };
    return variants;
}

const PhotonVariant& photon_variant_named(std::string_view name) {
    return item_named("variant", name, photon_variants(), &PhotonVariant::name);
}

PhotonSettings settings_of(const PhotonVariant& variant, PhotonSettings settings) {
    settings.scatter = variant.scatter;
    settings.classic = variant.classic;
    settings.roulette = variant.roulette;
    return settings;
}

std::uint32_t iterations_of(const PhotonVariant& variant, std::uint32_t iterations) {
    return std::max(iterations / variant.slowness, 1u);
}

}  // namespace voxilux
