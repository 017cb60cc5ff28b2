// The sections of which a scene file has one: [render], [sun], [sky]. toml_camera.cpp reads [camera].

#include <array>
#include <limits>

#include <fmt/format.h>

#include "formats/toml_colour.h"
#include "formats/toml_scene.h"
#include "formats/toml_section.h"

namespace voxilux {
namespace {

constexpr int kMaxPictureSide = 65535;  // pixels
constexpr std::int64_t kMaxAoRays = 65535;
constexpr double kMaxAoRadius = 65536.0;  // voxels

}  // namespace

void read_render(TomlScene& in) {
    const toml::table* table = find_section(in, "render");
    if (table == nullptr) return;
    const TomlSection section(*table, "[render]",
                              {"size", "spp", "ao_rays", "ao_radius", "seed", "sequence"});
    RenderSettings& settings = in.scene.settings;
    settings.size = section.integers2("size", 1, kMaxPictureSide).value_or(settings.size);
    const auto whole = [&](std::string_view key, std::int64_t low, std::int64_t high, std::uint32_t& value) {
        if (const auto number = section.integer(key, low, high)) value = static_cast<std::uint32_t>(*number);
    };
    whole("spp", 1, std::numeric_limits<std::uint32_t>::max(), settings.spp);
    whole("ao_rays", 1, kMaxAoRays, settings.ao_rays);
    whole("seed", 0, std::numeric_limits<std::uint32_t>::max(), settings.seed);
    if (const auto radius = section.number("ao_radius", {0.0, kMaxAoRadius, true}))
        settings.ao_radius = static_cast<float>(*radius);
    if (const auto choice = section.choice("sequence", kSequenceNames))
        settings.sequence = static_cast<Sequence>(*choice);
}

void read_sun(TomlScene& in) {
    const toml::table* table = find_section(in, "sun");
    if (table == nullptr) return;
    const TomlSection section(*table, "[sun]",
                              {"azimuth", "elevation", "angular_diameter", "irradiance", "on"});
    Sun& sun = in.scene.sun;
    const auto angle = [&](std::string_view key, Range range, float& value) {
        if (const auto number = section.number(key, range)) value = static_cast<float>(*number);
    };
    angle("azimuth", {-kMaxTurn, kMaxTurn}, sun.azimuth_deg);
    angle("elevation", {-90.0, 90.0}, sun.elevation_deg);
    angle("angular_diameter", {0.0, 180.0, false, true}, sun.angular_diameter_deg);
    if (const auto irradiance = section.numbers3("irradiance", kLightRange))
        sun.irradiance = glm::vec3(*irradiance);
    sun.on = section.boolean("on").value_or(sun.on);
}

void read_sky(TomlScene& in) {
    const toml::table* table = find_section(in, "sky");
    if (table == nullptr) return;
    const TomlSection section(*table, "[sky]", {"radiance", "color"});
    if (section.has("radiance") && section.has("color")) section.refuse("color", "excludes 'radiance'");
    if (const auto colour = read_colour(section, "color")) in.scene.sky.radiance = *colour;
    if (const auto radiance = section.numbers3("radiance", kLightRange))
        in.scene.sky.radiance = glm::vec3(*radiance);
}

}  // namespace voxilux
