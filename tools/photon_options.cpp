#include "photon_options.h"

#include <CLI/CLI.hpp>
#include <charconv>

#include "base/error.h"

namespace voxilux {

void add_photon_flags(CLI::App& command, PhotonOptions& options) {
    command
        .add_option("--photons", options.count,
                    "photons of an iteration; 0: as many as the picture has pixels")
        ->type_name("N")
        ->group("Sampling");
    command
        .add_option("--radius", options.radius,
                    "radius of photons in the first iteration, in voxels, or auto")
        ->type_name("R")
        ->group("Sampling");
    command
        .add_option("--alpha", options.alpha,
                    "how slowly that radius declines, above 0 and up to 1, where it stays")
        ->type_name("A")
        ->group("Sampling");
}

PhotonSettings with_photons(PhotonSettings settings, const PhotonOptions& options) {
    if (options.count) {
        if (*options.count < 0 || *options.count > PhotonSettings::kMostCount)
            throw Error(ExitCode::usage, fmt::format("--photons: {} is not from 0 to {}", *options.count,
                                                     PhotonSettings::kMostCount));
        settings.count = static_cast<std::uint32_t>(*options.count);
    }
    if (options.radius) settings.radius = parse_photon_radius(*options.radius);
    if (options.alpha) {
        if (!(*options.alpha > 0.0 && *options.alpha <= 1.0))
            throw Error(ExitCode::usage,
                        fmt::format("--alpha: {} is not above 0 and up to 1", *options.alpha));
        settings.alpha = *options.alpha;
    }
    return settings;
}

std::optional<double> parse_photon_radius(const std::string& text) {
    if (text == "auto") return {};
    double radius = 0.0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, radius);
    if (error == std::errc() && rest == end && radius > 0.0 && radius <= PhotonSettings::kLargestRadius)
        return radius;
    throw Error(ExitCode::usage,
                fmt::format("--radius: '{}' is neither auto nor a number of voxels above 0 and up to {}",
                            text, PhotonSettings::kLargestRadius));
}

}  // namespace voxilux
