#pragma once

// Quality presets: settings that belong together, chosen from measured prices.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace voxilux {

// How many samples a preset takes, and what that costs: medians over scenes as measured by voxilux tradeoff.
struct QualityPrice {
    std::uint32_t samples = 0;           // per pixel
    double error = 0.0;                  // root of relMSE
    double seconds_per_megapixel = 0.0;  // taking the samples
};

struct QualityPreset {
    std::string_view name;
    std::uint32_t ao_rays = 0;  // per sample
    QualityPrice plain;         // of scenes without photons
    QualityPrice photons;       // of scenes with photons, whose samples are iterations
};

// The preset of a name. Throws Error(usage) that lists the names.
[[nodiscard]] const QualityPreset& quality_named(std::string_view name);

// From the quickest to the finest.
[[nodiscard]] std::span<const QualityPreset> quality_presets();

// The samples and the price of the preset, in a scene with photons or without.
[[nodiscard]] const QualityPrice& price_of(const QualityPreset& preset, bool sends_photons);

// What the preset sets in a scene without photons, as "key=value" of a scene file.
[[nodiscard]] std::vector<std::string> overrides_of(const QualityPreset& preset);

// "draft|normal|...", for --help, and the presets with their prices.
[[nodiscard]] std::string quality_names();
[[nodiscard]] std::string quality_help();

}  // namespace voxilux
