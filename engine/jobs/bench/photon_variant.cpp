#include "jobs/bench/photon_variant.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "base/error.h"

namespace voxilux {
namespace {

const PhotonVariant& variant_named(const std::string& name) {
    const auto found = std::ranges::find(photon_variants(), name, &PhotonVariant::name);
    if (found != photon_variants().end()) return *found;
    std::vector<std::string> known;
    for (const PhotonVariant& variant : photon_variants())
        known.push_back(variant.name);
    throw Error(ExitCode::usage, fmt::format("no variant '{}'; there are {}", name, fmt::join(known, ", ")));
}

}  // namespace

const std::vector<PhotonVariant>& photon_variants() {
    static const std::vector<PhotonVariant> variants = {
        {.name = "gather"},
        {.name = "no-roulette", .roulette = false},
        {.name = "classic", .classic = true},
        {.name = "scatter", .scatter = true, .slowness = 16},
    };
    return variants;
}

std::vector<PhotonVariant> photon_variants_named(std::span<const std::string> names) {
    if (names.empty()) return photon_variants();
    std::vector<PhotonVariant> variants;
    for (const std::string& name : names) {
        if (std::ranges::find(variants, name, &PhotonVariant::name) == variants.end())
            variants.push_back(variant_named(name));
    }
    return variants;
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
