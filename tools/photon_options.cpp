#include "photon_options.h"

#include <CLI/CLI.hpp>
#include <charconv>

#include "base/error.h"
#include "in_range.h"

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
    if (options.count)
        settings.count =
            static_cast<std::uint32_t>(in_range<PhotonSettings>("--photons", "count", *options.count));
    if (options.radius) settings.radius = parse_photon_radius(*options.radius);
    if (options.alpha) settings.alpha = in_range<PhotonSettings>("--alpha", "alpha", *options.alpha);
    return settings;
}

std::optional<double> parse_photon_radius(const std::string& text) {
    if (text == "auto") return {};
    double radius = 0.0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, radius);
    const Range range = setting_of<PhotonSettings>("radius").range;
    if (error == std::errc() && rest == end && range.holds(radius)) return radius;
    throw Error(ExitCode::usage, fmt::format("--radius: '{}' is neither auto nor a number of voxels in {}",
                                             text, to_string(range)));
}

}  // namespace voxilux
