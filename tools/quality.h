#pragma once

// Quality presets: settings that belong together, chosen from measured prices.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace voxilux {

// What a preset sets, and its price: medians over scenes as measured by voxilux tradeoff.
struct QualityPreset {
    std::string_view name;
    std::uint32_t spp = 0;               // samples per pixel, also iterations of photons
    std::uint32_t ao_rays = 0;           // per sample
    std::uint32_t photons = 0;           // per iteration; 0: as many as the picture has pixels
    double error = 0.0;                  // root of relMSE
    double seconds_per_megapixel = 0.0;  // taking the samples
};

// The preset of a name. Throws Error(usage) that lists the names.
[[nodiscard]] const QualityPreset& quality_named(std::string_view name);

// What the preset sets as "key=value" of a scene file.
[[nodiscard]] std::vector<std::string> overrides_of(const QualityPreset& preset);

// The presets and their prices, for --help.
[[nodiscard]] std::string quality_help();

}  // namespace voxilux
