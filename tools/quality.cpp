#include "quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/error.h"

namespace voxilux {
namespace {

#include "quality_presets.inc"

std::string names() {
    std::string text;
    for (const QualityPreset& preset : kPresets)
        text += fmt::format("{}{}", text.empty() ? "" : ", ", preset.name);
    return text;
}

}  // namespace

const QualityPreset& quality_named(std::string_view name) {
    const auto* const found = std::ranges::find(kPresets, name, &QualityPreset::name);
    if (found == kPresets.end())
        throw Error(ExitCode::usage, fmt::format("--quality: '{}' is none of {}", name, names()));
    return *found;
}

std::vector<std::string> overrides_of(const QualityPreset& preset) {
    return {fmt::format("render.spp={}", preset.spp), fmt::format("render.ao_rays={}", preset.ao_rays),
            fmt::format("photons.count={}", preset.photons)};
}

std::string quality_help() {
    std::string text = fmt::format(
        "settings in one word, which other flags win over; medians of {} scenes\non {}:", kPricedScenes,
        kPricedOn);
    for (const QualityPreset& preset : kPresets) {
        text += fmt::format("\n{:<9} {:>5} samples, error {:>3.2g} %, {:>5g} s per megapixel", preset.name,
                            preset.spp, 100.0 * preset.error, preset.seconds_per_megapixel);
    }
    return text;
}

}  // namespace voxilux
