#include "quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/error.h"

namespace voxilux {
namespace {

#include "quality_presets.inc"

std::string names(std::string_view between) {
    std::string text;
    for (const QualityPreset& preset : kPresets)
        text += fmt::format("{}{}", text.empty() ? "" : between, preset.name);
    return text;
}

}  // namespace

std::string quality_names() {
    return names("|");
}

const QualityPreset& quality_named(std::string_view name) {
    const auto* const found = std::ranges::find(kPresets, name, &QualityPreset::name);
    if (found == kPresets.end())
        throw Error(ExitCode::usage, fmt::format("--quality: '{}' is none of {}", name, names(", ")));
    return *found;
}

std::span<const QualityPreset> quality_presets() {
    return kPresets;
}

const QualityPrice& price_of(const QualityPreset& preset, bool sends_photons) {
    return sends_photons ? preset.photons : preset.plain;
}

std::vector<std::string> overrides_of(const QualityPreset& preset) {
    return {fmt::format("render.spp={}", preset.plain.samples),
            fmt::format("render.ao_rays={}", preset.ao_rays)};
}

std::string quality_help() {
    std::string text = fmt::format(
        "sets samples and occlusion rays together; other flags override it. Error and time are\n"
        "medians of {} plain scenes and {} in which photons run, on\n{}:",
        kPlainScenes, kPhotonScenes, kPricedOn);
    for (const QualityPreset& preset : kPresets) {
        text += fmt::format("\n{:<9}", preset.name);
        const std::pair<const char*, QualityPrice> kinds[] = {{"plain", preset.plain},
                                                              {"photons", preset.photons}};
        for (const auto& [kind, price] : kinds)
            text += fmt::format("  {} {:>4} samples, {:>3.2g} %, {:>4g} s per megapixel", kind, price.samples,
                                100.0 * price.error, price.seconds_per_megapixel);
    }
    return text;
}

}  // namespace voxilux
