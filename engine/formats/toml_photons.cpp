// The section [photons] of a scene file: how indirect light and caustics are found.

#include "formats/toml_scene.h"
#include "formats/toml_section.h"

namespace voxilux {

void read_photons(TomlScene& in) {
    const toml::table* table = find_section(in, "photons");
    if (table == nullptr) return;
    const TomlSection section(*table, "[photons]",
                              {"count", "radius", "alpha", "scatter", "classic", "roulette", "depth"});
    PhotonSettings& photons = in.scene.settings.photons;
    if (const auto count = section.integer("count", 0, PhotonSettings::kMostCount))
        photons.count = static_cast<std::uint32_t>(*count);
    photons.radius = section.number("radius", {0.0, PhotonSettings::kLargestRadius, true});
    photons.alpha = section.number("alpha", {0.0, 1.0, true}).value_or(photons.alpha);
    photons.scatter = section.boolean("scatter").value_or(photons.scatter);
    photons.classic = section.boolean("classic").value_or(photons.classic);
    photons.roulette = section.boolean("roulette").value_or(photons.roulette);
    if (const auto depth = section.integer("depth", 1, PhotonSettings::kDeepest))
        photons.depth = static_cast<std::uint32_t>(*depth);
}

}  // namespace voxilux
