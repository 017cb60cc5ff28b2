#pragma once

// Flags of photon mapping: common to the subcommands that read a scene.

#include <cstdint>
#include <optional>
#include <string>

#include "scene/photon_settings.h"

namespace CLI {
class App;
}

namespace voxilux {

// The flags as typed; empty where the user said nothing.
struct PhotonOptions {
    std::optional<std::int64_t> count;
    std::optional<std::string> radius;  // a number or "auto"
    std::optional<double> alpha;
};

// Parsing fills `options`, which must outlive the app.
void add_photon_flags(CLI::App& command, PhotonOptions& options);

// The settings with the flags applied. Throws Error(usage) for a value out of the range that a scene file
// has.
[[nodiscard]] PhotonSettings with_photons(PhotonSettings settings, const PhotonOptions& options);

// "2.5", a radius in voxels; nothing for "auto". Throws Error(usage) for anything else.
[[nodiscard]] std::optional<double> parse_photon_radius(const std::string& text);

}  // namespace voxilux
