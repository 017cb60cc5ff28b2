// The sections of which a scene file has one: [render], [sun], [sky], [camera].

#include <array>
#include <limits>

#include <fmt/format.h>

#include "scene/scene_bounds.h"
#include "scene/scene_camera.h"
#include "scene/toml_colour.h"
#include "scene/toml_scene.h"
#include "scene/toml_section.h"

namespace voxilux {
namespace {

constexpr int kMaxPictureSide = 65535;  // pixels
constexpr std::int64_t kMaxAoRays = 65535;
constexpr double kMaxAoRadius = 65536.0;  // voxels
constexpr double kMaxTurn = 3600.0;       // degrees; ten turns, for the sake of animations

bool names_direction(const TomlSection& section) {
    return section.has("look_at") || section.has("yaw") || section.has("pitch");
}

Camera placed_camera(const TomlSection& section, glm::dvec3 position, double fov_y_deg) {
    const auto look_at = section.numbers3("look_at", {-kMaxCoordinate, kMaxCoordinate});
    const auto yaw = section.number("yaw", {-kMaxTurn, kMaxTurn});
    const auto pitch = section.number("pitch", {-90.0, 90.0});
    if (look_at && (yaw || pitch))
        section.refuse("look_at", "excludes 'yaw' and 'pitch': give one or the other");
    if (!look_at && !(yaw && pitch)) section.refuse("with 'position' needs 'look_at', or 'yaw' and 'pitch'");
    if (look_at && *look_at == position) section.refuse("look_at", "must differ from 'position'");
    const YawPitch direction = look_at ? yaw_pitch_of(*look_at - position) : YawPitch{*yaw, *pitch};
    return {position, direction.yaw_deg, direction.pitch_deg, fov_y_deg};
}

Camera framing(const TomlScene& in, const TomlSection& section, View view, double fov_y_deg) {
    const glm::dvec2 size(in.scene.settings.size);
    const Camera camera = framing_camera(scene_bounds(in.scene), view, size.x / size.y, fov_y_deg);
    if (!(glm::length(camera.position) <= kMaxCoordinate))
        section.refuse("fov", "is so narrow that the whole scene fits only from beyond 2^30 voxels away");
    return camera;
}

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
    constexpr std::array<std::string_view, 3> kNames{"sobol", "halton", "white"};  // in the order of Sequence
    if (const auto choice = section.choice("sequence", kNames))
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

void read_camera(TomlScene& in) {
    const toml::table* table = find_section(in, "camera");
    if (table == nullptr) return;
    const TomlSection section(*table, "[camera]", {"position", "look_at", "yaw", "pitch", "fov", "preset"});
    constexpr std::array<std::string_view, 7> kViews{
        "three_quarter", "front", "back", "left", "right", "top", "iso"};  // in the order of View
    const auto fov = section.number("fov", {0.0, 180.0, true, true});
    const auto view = section.choice("preset", kViews);
    const auto position = section.numbers3("position", {-kMaxCoordinate, kMaxCoordinate});
    if (view && (position || names_direction(section)))
        section.refuse("preset", "excludes 'position', 'look_at', 'yaw' and 'pitch'");
    if (!position && names_direction(section)) section.refuse("needs 'position' or 'preset'");
    if (position) {
        in.scene.camera = placed_camera(section, *position, fov.value_or(kDefaultFovYDeg));
    } else if (view || fov) {
        const auto framed = static_cast<View>(view.value_or(static_cast<std::size_t>(View::three_quarter)));
        in.scene.camera = framing(in, section, framed, fov.value_or(kDefaultFovYDeg));
    }
}

}  // namespace voxilux
