#pragma once

// The settings of a scene as rows: name, what is allowed, what it means, and the member that holds it. Scene
// files and -D are read, flags checked, scenes hashed and the tables of scenes/README.md written from these
// rows. Each list of rows starts by naming every member of its struct, so that a new member does not compile
// until somebody has decided.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/assert.h"
#include "scene/scene.h"
#include "scene/scene_bounds.h"
#include "scene/scene_camera.h"
#include "scene/vox_animation.h"

namespace voxilux {

// Allowed values of a number; infinities and NaN never are.
struct Range {
    double low = 0.0;
    double high = 0.0;
    bool open_low = false;
    bool open_high = false;

    [[nodiscard]] bool holds(double value) const;
};

// "(0, 180)": round where the end itself is not allowed.
[[nodiscard]] std::string to_string(Range range);

constexpr Range above(double low, double high) {
    return {low, high, true, false};
}
constexpr Range below(double low, double high) {
    return {low, high, false, true};
}
constexpr Range between(double low, double high) {
    return {low, high, true, true};
}

inline constexpr Range kWhole{0, 4294967295};
// Radiance and irradiance: far above any sun, and the square still fits a float.
inline constexpr Range kLight{0, kMaxRadiance};
// Multiples of the Earth's; at 100 no light gets through.
inline constexpr Range kDensity{0, 100};
// Degrees: ten turns, for the sake of animations.
inline constexpr Range kTurn{-3600, 3600};
inline constexpr Range kPitch{-90, 90};  // degrees
inline constexpr Range kPlace{-kMaxCoordinate, kMaxCoordinate};
inline constexpr double kMaxPixelsPerVoxel = 4096;
// Centre and radius of a sphere, whose sum is then in kPlace.
inline constexpr Range kReach{-kMaxCoordinate / 2, kMaxCoordinate / 2};

// One row. A number is in `range`. A value with `choices` is written as one of these names, which are in the
// order of the values.
struct Setting {
    std::string_view name;
    Range range;
    std::string_view sentence;
    std::span<const std::string_view> choices;
    bool is_required = false;
};

[[nodiscard]] constexpr Setting required(Setting setting) {
    setting.is_required = true;
    return setting;
}

// Another way to write a colour, as "#rrggbb" in sRGB; excludes the key `linear_key`, which gives it in
// linear numbers.
struct HexColour {
    glm::vec3& linear;
    std::string_view linear_key;
};

// What a scene file says about where the camera stands. A direction is a point to look at, or yaw and pitch.
struct CameraPlacement {
    std::optional<glm::dvec3> position;
    std::optional<glm::dvec3> look_at;
    std::optional<double> yaw_deg;
    std::optional<double> pitch_deg;
    double fov_y_deg = kDefaultFovYDeg;
};

inline constexpr std::array<std::string_view, 8> kViewNames{
    "three_quarter", "front", "back", "left", "right", "top", "bottom", "iso"};  // in the order of View

// [camera], less its keys and its turntable.
struct CameraSettings {
    CameraPlacement placement;
    std::optional<View> preset;
    CameraPath path = CameraPath::smooth;
    Projection projection = Projection::perspective;
    std::optional<double> pixels_per_voxel;
    Lens lens;
};

// [[camera.key]]
struct CameraKeySettings {
    std::int64_t frame = 0;
    CameraPlacement placement;
};

// visit_settings(settings, visit) calls visit(const Setting&, member) for each row of a section.

void visit_settings(RenderSettings& settings, auto&& visit) {
    auto& [size, spp, ao_rays, ao_radius, seed, sequence, traces_air, ao, photons, paths] =
        settings;  // the last three are sections
    visit({"size", {1, 65535}, "width and height, pixels"}, size);
    visit({"spp", {1, 4294967295}, "samples per pixel"}, spp);
    visit({"ao_rays", {1, 65535}, "occlusion rays per sample"}, ao_rays);
    visit({"ao_radius", above(0, 65536), "reach of occlusion rays, voxels"}, ao_radius);
    visit({"seed", kWhole, "of every random stream"}, seed);
    visit({"sequence", {}, "sample sequence", kSequenceNames}, sequence);
    visit({"traces_air", {}, "true: paths find the light of an atmosphere, as `sky=reference` does"},
          traces_air);
}

void visit_settings(AoSettings& settings, auto&& visit) {
    auto& [method, cell_px, reproject, merged, checkerboard, by_pixel, filter, sample_limit, slots] =
        settings;
    visit({"method", {}, "see Occlusion", kAoMethodNames}, method);
    visit({"cell_px", above(0, 4096), "largest width of a cell, pixels"}, cell_px);
    visit({"reproject", {}, "look first where the last sample saw the cell; absent: on GPUs"}, reproject);
    visit({"merged", {}, "search and sample in one pass; absent: on CPUs"}, merged);
    visit({"checkerboard", {}, "every other pixel takes samples"}, checkerboard);
    visit({"sampling", {}, "whose points and sequence rays take", kAoSamplingNames}, by_pixel);
    visit({"filter", {0, 4}, "iterations of a smoothing filter"}, filter);
    visit({"sample_limit", kWhole, "a cell takes no more samples; 0: no limit"}, sample_limit);
    visit({"slots", {0, 1 << 24}, "of the table, a power of two; 0: the plan chooses"}, slots);
}

void visit_settings(PhotonSettings& settings, auto&& visit) {
    auto& [count, radius, alpha, scatter, classic, roulette, depth, aim, caustics, indirect] = settings;
    visit({"count", {0, PhotonSettings::kMaxCount}, "in an iteration; 0: one for each pixel"}, count);
    visit({"radius", above(0, 65536), "of the first iteration, voxels; absent: chosen"}, radius);
    visit({"alpha", above(0, 1), "exponent of the radius' decline; 1: it stays"}, alpha);
    visit({"scatter", {}, "photons look for points: the same sums, slower"}, scatter);
    visit({"classic", {}, "a radius for each pixel, which shrinks as photons arrive"}, classic);
    visit({"roulette", {}, "chance ends paths, without bias; false: `depth` does"}, roulette);
    visit({"depth", {1, 4096}, "surfaces on a path without roulette"}, depth);
    visit({"aim", {}, "where they serve caustics alone, they start towards mirrors and glass"}, aim);
    visit({"caustics", {}, "false: nothing finds them, as with the technique `none`"}, caustics);
    visit({"indirect", {}, "likewise indirect light"}, indirect);
}

void visit_settings(PathSettings& settings, auto&& visit) {
    auto& [indirect, caustics, plain] = settings;
    visit({"indirect", {}, "true: paths find it, false: photons; absent: chosen"}, indirect);
    visit({"caustics", {}, "likewise; see Techniques"}, caustics);
    visit({"plain", {}, "true: they meet emitters by chance alone, as `reference` does"}, plain);
}

void visit_settings(Sun& sun, auto&& visit) {
    auto& [azimuth_deg, elevation_deg, angular_diameter_deg, irradiance, on] = sun;
    visit({"azimuth", kTurn, "degrees counter-clockwise from +x, seen from above"}, azimuth_deg);
    visit({"elevation", kPitch, "degrees above the horizon"}, elevation_deg);
    visit({"angular_diameter", below(0, 180), "degrees; 0 gives hard shadows"}, angular_diameter_deg);
    visit({"irradiance", kLight, "on a surface that faces the sun, above any air"}, irradiance);
    visit({"on", {}, "whether it shines"}, on);
}

void visit_settings(Sky& sky, auto&& visit) {
    auto& [model, radiance, image_file, rotation_deg, strength, image, altitude_m, metres_per_voxel, rayleigh,
           mie, ozone, mie_g, ground_albedo, resolution] = sky;  // the image is in the file
    visit({"model", {}, "see Sky", kSkyModelNames}, model);
    visit({"radiance", kLight, "of the constant sky, from every direction"}, radiance);
    visit({"color", {}, "the same in sRGB"}, HexColour{radiance, "radiance"});
    visit({"image", {}, "file of the image; makes it the model unless `model` is given"}, image_file);
    visit({"rotation", kTurn, "of the image, degrees counter-clockwise seen from above"}, rotation_deg);
    visit({"strength", kLight, "factor of its radiance"}, strength);
    visit({"altitude", {0, 1e6}, "of z = 0 above the planet's ground, metres"}, altitude_m);
    visit({"metres_per_voxel", above(0, 1e6), "size of the scene in the air"}, metres_per_voxel);
    visit({"rayleigh", kDensity, "density of the air; 1 is the Earth's"}, rayleigh);
    visit({"mie", kDensity, "of aerosol"}, mie);
    visit({"ozone", kDensity, "of ozone"}, ozone);
    visit({"mie_g", {-0.99, 0.99}, "mean cosine of the angle by which aerosol scatters"}, mie_g);
    visit({"ground_albedo", {0, 1}, "of the planet's ground"}, ground_albedo);
    visit({"resolution", {16, 512}, "rows of the sky's table above the horizon"}, resolution);
}

void visit_settings(Background& background, auto&& visit) {
    auto& [shown, radiance] = background;
    visit({"shown", {}, "behind the scene; see Background", kBackdropNames}, shown);
    visit({"radiance", kLight, "of a color; makes it the one shown unless `shown` is given"}, radiance);
    visit({"color", {}, "the same in sRGB"}, HexColour{radiance, "radiance"});
}

void visit_settings(Ground& ground, auto&& visit) {
    auto& [on, albedo, shadow_only, height] = ground;
    visit({"on", {}, "true where the section is there and does not say"}, on);
    visit({"albedo", {0, 1}, "share of light that is reflected, linear"}, albedo);
    visit({"color", {}, "the same in sRGB"}, HexColour{albedo, "albedo"});
    visit({"shadow_only", {}, "before a background: nothing but shadows; see Ground"}, shadow_only);
    visit({"height", kReach, "of the plane, z in voxels; absent: the scene's lowest"}, height);
}

void visit_settings(CameraPlacement& placement, auto&& visit) {
    auto& [position, look_at, yaw_deg, pitch_deg, fov_y_deg] = placement;
    visit({"position", kPlace, "of the camera"}, position);
    visit({"look_at", kPlace, "the point in the middle of the image"}, look_at);
    visit({"yaw", kTurn, "instead: degrees counter-clockwise from +x, seen from above"}, yaw_deg);
    visit({"pitch", kPitch, "with it: degrees above the horizon"}, pitch_deg);
    visit({"fov", above(0, 360), "vertical, degrees; below 180 but for a fisheye"}, fov_y_deg);
}

void visit_settings(Lens& lens, auto&& visit) {
    auto& [aperture, blades, focus, focus_at] = lens;
    visit({"aperture", {0, 65536}, "diameter, voxels; 0 is a pinhole; see Cameras"}, aperture);
    visit({"blades", {0, 64}, "corners of the aperture; below 3 it is round"}, blades);
    visit({"focus", above(0, kMaxCoordinate), "distance of what is sharp, along the view axis, voxels"},
          focus);
    visit({"focus_at", kPlace, "instead: a point; absent: the middle of the scene"}, focus_at);
}

void visit_settings(CameraSettings& settings, auto&& visit) {
    auto& [placement, preset, path, projection, pixels_per_voxel, lens] = settings;
    visit_settings(placement, visit);
    visit({"preset", {}, "frames a scene", kViewNames}, preset);
    visit({"path", {}, "of the camera between its keys", kCameraPathNames}, path);
    visit({"projection", {}, "see Cameras", kProjectionNames}, projection);
    visit({"pixels_per_voxel", above(0, kMaxPixelsPerVoxel), "size of an orthographic image of the scene"},
          pixels_per_voxel);
    visit_settings(lens, visit);
}

void visit_settings(CameraKeySettings& settings, auto&& visit) {
    auto& [frame, placement] = settings;
    visit(required({"frame", {0, kMaxFrame}, "when the camera is there"}), frame);
    visit_settings(placement, visit);
}

void visit_settings(Turntable& turntable, auto&& visit) {
    auto& [frames, degrees, start_deg, turned] = turntable;
    visit(required({"frames", {1, kMaxFrame}, "of one turn"}), frames);
    visit({"degrees", kTurn, "of one turn; negative goes clockwise"}, degrees);
    visit({"start", kTurn, "degrees at frame 1"}, start_deg);
    visit({"turn", {}, "what turns", kTurnedNames}, turned);
}

void visit_settings(Material& material, auto&& visit) {
    // Metallic and transmission follow from the surface. Nothing transparent refracts more than germanium, 4.
    auto& [name, albedo, emission, surface, roughness, ior, metallic, transmission] = material;
    visit({"color", {}, "albedo in sRGB"}, HexColour{albedo, "albedo"});
    visit({"albedo", {0, 1}, "share of light that is reflected, linear"}, albedo);
    visit({"surface", {}, "how light leaves it", kSurfaceNames}, surface);
    visit({"emission", kLight, "radiance; makes the surface `emit` unless it says otherwise"}, emission);
    visit({"roughness", {0, 1}, "0 for metal and glass that name none"}, roughness);
    visit({"ior", {1, 4}, "index of refraction of glass"}, ior);
}

void visit_settings(Sphere& sphere, auto&& visit) {
    auto& [centre, radius, material] = sphere;  // materials are found by name
    visit(required({"center", kReach, "of the sphere"}), centre);
    visit(required({"radius", above(0, kReach.high), "voxels"}), radius);
}

// Calls visit(name, settings) for each section that a scene file has at most once, except for [camera]: a
// scene keeps the camera that this section leads to, not its settings.
void visit_sections(auto& scene, auto&& visit) {
    visit("render", scene.settings);
    visit("ao", scene.settings.ao);
    visit("photons", scene.settings.photons);
    visit("paths", scene.settings.paths);
    visit("sun", scene.sun);
    visit("sky", scene.sky);
    visit("background", scene.background);
    visit("ground", scene.ground);
}

// The row of a name.
template <class Settings>
[[nodiscard]] Setting setting_of(std::string_view name) {
    Settings settings;
    Setting found;
    visit_settings(settings, [&](const Setting& row, auto&&) {
        if (row.name == name) found = row;
    });
    VX_ASSERT(!found.name.empty());
    return found;
}

}  // namespace voxilux
