// The keys have no public specification. Their meaning is taken from the names of the settings in the editor
// and from other readers of the format: camera and sun from opengametools (ogt_vox.h: focus, angle as pitch,
// yaw and roll, radius, frustum; the sun's angle as elevation and azimuth, an area of 1 being about 43.5
// degrees). The rest is assumed, and scenes/README.md says so.

#include "scene/vox_settings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include <fmt/format.h>

#include "base/colour.h"
#include "base/printable.h"
#include "scene/angles.h"
#include "scene/scene_camera.h"
#include "scene/vox_graph.h"

namespace voxilux {
namespace {

constexpr std::size_t kMaxNotes = 64;
constexpr double kDegreesOfArea = 43.5;   // angular diameter of a sun of area 1
constexpr double kEarthsDensity = 0.4;    // of air and aerosol: what the editor starts with
constexpr double kFrontAzimuth = 270.0;   // degrees; from the front of the model, which is -y
constexpr double kBehindAzimuth = 90.0;   // degrees
constexpr double kMaxIntensity = 1000.0;  // far above the editor's sliders
constexpr double kMaxExposureStops = 16.0;
constexpr double kUnusedRadius = 1.0;  // of a camera slot that was never set, at most

// What the editor writes, in all its versions, when the user has changed nothing. A key that an object lacks,
// or that is not here, decides nothing.
struct Usual {
    std::string_view type;
    std::string_view key;
    std::array<std::string_view, 2> values;
};

constexpr Usual kUsual[] = {
    {"_inf", "_i", {"0.7", "0.6"}},     {"_inf", "_k", {"255 255 255", ""}},
    {"_inf", "_angle", {"50 50", ""}},  {"_inf", "_area", {"0.07", ""}},
    {"_uni", "_i", {"0.7", ""}},        {"_uni", "_k", {"255 255 255", ""}},
    {"_env", "_mode", {"0", ""}},       {"_ground", "_color", {"80 80 80", ""}},
    {"_lens", "_fov", {"45", ""}},      {"_lens", "_aperture", {"0.25", ""}},
    {"_lens", "_proj", {"0", ""}},      {"_film", "_expo", {"1", ""}},
    {"_film", "_stops", {"0", ""}},     {"_film", "_vig", {"0", ""}},
    {"_film", "_gam", {"2.2", ""}},     {"_fog_uni", "_d", {"0", "0.2"}},
    {"_bounce", "_diffuse", {"2", ""}}, {"_bounce", "_specular", {"5", ""}},
    {"_bounce", "_scatter", {"5", ""}}, {"_bounce", "_energy", {"3", ""}},
    {"_bloom", "_scale", {"0", "1"}},
};

bool is_usual(std::string_view type, std::string_view key, std::string_view value) {
    return std::ranges::any_of(kUsual, [&](const Usual& row) {
        return row.type == type && row.key == key && std::ranges::find(row.values, value) != row.values.end();
    });
}

// The first three numbers of a text, 0 for those that it lacks; nothing when a word is not a number.
std::optional<glm::dvec3> numbers_of(std::string_view text) {
    glm::dvec3 numbers(0.0);
    for (int i = 0; i < 3 && !text.empty(); ++i) {
        const std::size_t end = std::min(text.find(' '), text.size());
        const auto number = parse_number(text.substr(0, end));
        if (!number || !std::isfinite(*number)) return {};
        numbers[i] = *number;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return numbers;
}

// The settings of a file by type and key. Later objects win.
class Settings {
  public:
    Settings(std::span<const VoxDict> objects, Scene& scene) : objects_(objects), scene_(scene) {}

    [[nodiscard]] const std::string* text(std::string_view type, std::string_view key) const {
        const std::string* found = nullptr;
        for (const VoxDict& object : objects_) {
            const std::string* own = find_value(object, "_type");
            const std::string* value = find_value(object, key);
            if (own != nullptr && *own == type && value != nullptr) found = value;
        }
        return found;
    }

    // Whether the author has changed any of these keys.
    [[nodiscard]] bool is_set(std::string_view type, std::initializer_list<std::string_view> keys) const {
        return std::ranges::any_of(keys, [&](std::string_view key) {
            const std::string* value = text(type, key);
            return value != nullptr && !is_usual(type, key, *value);
        });
    }

    [[nodiscard]] glm::dvec3 numbers(std::string_view type, std::string_view key, glm::dvec3 usual) const {
        const std::string* value = text(type, key);
        if (value == nullptr) return usual;
        const auto numbers = numbers_of(*value);
        if (!numbers) warn(fmt::format("{} {} is {}, not numbers: ignored", type, key, quoted_name(*value)));
        return numbers.value_or(usual);
    }
    [[nodiscard]] double number(std::string_view type, std::string_view key, double usual, double low,
                                double high) const {
        const double value = numbers(type, key, glm::dvec3(usual)).x;
        const double inside = std::clamp(value, low, high);
        if (inside != value) warn(fmt::format("{} {} is {}, taken as {}", type, key, value, inside));
        return inside;
    }
    // The linear colour of three sRGB codes from 0 to 255.
    [[nodiscard]] glm::vec3 colour(std::string_view type, std::string_view key, double usual) const {
        const glm::dvec3 codes = glm::clamp(numbers(type, key, glm::dvec3(usual)), 0.0, 255.0);
        return {decode_srgb(codes.x / 255.0), decode_srgb(codes.y / 255.0), decode_srgb(codes.z / 255.0)};
    }
    [[nodiscard]] bool is_on(std::string_view type, std::string_view key) const {
        const std::string* value = text(type, key);
        return value != nullptr && *value == "1";
    }

    void warn(std::string what) const {
        if (scene_.warnings.size() < kVoxMaxWarnings) scene_.warnings.push_back(std::move(what));
    }
    void note(std::string what) const {
        if (scene_.notes.size() < kMaxNotes) scene_.notes.push_back(std::move(what));
    }

  private:
    std::span<const VoxDict> objects_;
    Scene& scene_;
};

// Azimuth of the editor's `angle`, which is clockwise from the front.
double azimuth_of(double angle_deg) {
    return kFrontAzimuth - angle_deg;
}

// An intensity is the radiance of a white surface that the light strikes at right angles.
void apply_sun(const Settings& settings, Sun& sun) {
    if (!settings.is_set("_inf", {"_i", "_k", "_angle", "_area"})) return;
    const glm::dvec3 angle = settings.numbers("_inf", "_angle", {50.0, 50.0, 0.0});
    const double intensity = settings.number("_inf", "_i", 0.7, 0.0, kMaxIntensity);
    const double area = settings.number("_inf", "_area", 0.07, 0.0, 4.0);
    sun.elevation_deg = static_cast<float>(std::clamp(angle.x, -90.0, 90.0));
    sun.azimuth_deg = static_cast<float>(std::remainder(azimuth_of(angle.y), 360.0));
    sun.angular_diameter_deg = static_cast<float>(kDegreesOfArea * area);
    sun.irradiance = static_cast<float>(std::numbers::pi * intensity) * settings.colour("_inf", "_k", 255.0);
}

void apply_atmosphere(const Settings& settings, Sky& sky) {
    sky.model = SkyModel::atmosphere;
    const auto density = [&](std::string_view key, double usual) {
        return static_cast<float>(settings.number("_atm", key, usual, 0.0, 100.0 * kEarthsDensity) /
                                  kEarthsDensity);
    };
    sky.rayleigh = density("_ray_d", kEarthsDensity);
    sky.mie = density("_mie_d", kEarthsDensity);
    sky.ozone = density("_o3_d", 0.0);
    sky.mie_g = static_cast<float>(settings.number("_atm", "_mie_g", 0.85, -0.99, 0.99));
}

// Only a file beside the .vox is ever looked at, whatever folder the path names. The rotation is taken to be
// clockwise, as the azimuth of the sun is; that the middle of an image without one is behind the model, as
// seen from the front, is assumed.
void apply_sky_image(const Settings& settings, Scene& scene) {
    const std::string* path = settings.text("_ibl", "_path");
    const std::string name = path == nullptr ? "" : path->substr(path->find_last_of("/\\") + 1);
    if (name.empty() || name == "." || name == "..") {
        settings.note("the settings name no image of the sky: our sky is shown");
        return;
    }
    const double azimuth = settings.numbers("_ibl", "_angle", glm::dvec3(0.0)).y;  // of older files
    const double angle = settings.numbers("_ibl", "_rot", glm::dvec3(azimuth)).x;
    scene.sky.model = SkyModel::image;
    scene.sky.image_file = name;
    scene.sky.rotation_deg = static_cast<float>(std::remainder(kBehindAzimuth - angle, 360.0));
    scene.sky.strength = static_cast<float>(settings.number("_ibl", "_i", 1.0, 0.0, kMaxIntensity));
}

// Modes: 0 a uniform sky, 1 an atmosphere, 2 an image. (The one known file that names an image of its own has
// mode 2.)
void apply_sky(const Settings& settings, Scene& scene) {
    const double mode = settings.number("_env", "_mode", 0.0, 0.0, 2.0);
    if (mode == 1.0) return apply_atmosphere(settings, scene.sky);
    if (mode == 2.0) return apply_sky_image(settings, scene);
    if (!settings.is_set("_uni", {"_i", "_k"})) return;
    const double intensity = settings.number("_uni", "_i", 0.7, 0.0, kMaxIntensity);
    scene.sky.radiance = static_cast<float>(intensity) * settings.colour("_uni", "_k", 255.0);
}

void apply_ground(const Settings& settings, Ground& ground) {
    const bool is_off =
        settings.text("_setting", "_ground") != nullptr && !settings.is_on("_setting", "_ground");
    const std::string* enabled = settings.text("_ground", "_enable");
    if (is_off || (enabled != nullptr && *enabled != "1") || !settings.is_set("_ground", {"_color"})) return;
    ground.on = true;
    ground.albedo = settings.colour("_ground", "_color", 80.0);
    if (settings.number("_ground", "_hor", 0.0, 0.0, 1.0) > 0.0)
        settings.note("the ground goes on to the horizon and does not fade there");
}

void apply_background(const Settings& settings, Background& background) {
    const std::string* enabled = settings.text("_bg", "_enable");
    const bool has_colour = settings.is_on("_setting", "_bg_c") || (enabled != nullptr && *enabled == "1");
    if (has_colour) background = {Backdrop::color, settings.colour("_bg", "_color", 0.0)};
    if (settings.is_on("_setting", "_bg_a")) background.shown = Backdrop::transparent;
}

void apply_lens_and_film(const Settings& settings, Scene& scene) {
    if (settings.is_set("_lens", {"_fov"}))
        scene.framing_fov_y_deg = settings.number("_lens", "_fov", 45.0, 1.0, 179.0);
    if (settings.is_set("_film", {"_expo"})) {
        const double factor = settings.number("_film", "_expo", 1.0, std::exp2(-kMaxExposureStops),
                                              std::exp2(kMaxExposureStops));
        scene.exposure_ev = static_cast<float>(std::log2(factor));
    } else if (settings.is_set("_film", {"_stops"})) {
        scene.exposure_ev = static_cast<float>(
            settings.number("_film", "_stops", 0.0, -kMaxExposureStops, kMaxExposureStops));
    }
}

void note_what_is_not_shown(const Settings& settings) {
    const auto note = [&](std::string_view type, std::initializer_list<std::string_view> keys,
                          const char* what) {
        if (settings.is_set(type, keys)) settings.note(what);
    };
    note("_lens", {"_aperture"}, "depth of field of the file is not shown: -D camera.aperture sets one");
    note("_lens", {"_proj"}, "the projection of the render settings is not used: --projection sets one");
    note("_film", {"_vig"}, "the vignette is not shown");
    note("_film", {"_gam"}, "the gamma of the film is not used: files are sRGB");
    note("_fog_uni", {"_d"}, "fog is not shown");
    note("_bloom", {"_scale"}, "bloom is not shown");
    note("_bounce", {"_diffuse", "_specular", "_scatter", "_energy"},
         "the number of bounces is not limited as the file asks");
    if (settings.is_on("_setting", "_edge")) settings.note("edges of voxels are not drawn");
    if (settings.is_on("_setting", "_grid")) settings.note("grid lines are not drawn");
}

glm::dvec3 camera_numbers(const VoxDict& values, std::string_view key) {
    const std::string* text = find_value(values, key);
    return text == nullptr ? glm::dvec3(0.0) : numbers_of(*text).value_or(glm::dvec3(0.0));
}

bool is_unused(const VoxDict& values) {
    return camera_numbers(values, "_focus") == glm::dvec3(0.0) &&
           camera_numbers(values, "_angle") == glm::dvec3(0.0) &&
           camera_numbers(values, "_radius").x <= kUnusedRadius;
}

// A pitch above 0 looks down; a yaw of 0 looks at the front, and one above 0 goes round clockwise.
SavedCamera camera_of_record(const VoxRecord& record) {
    const VoxDict& values = record.attributes;
    const glm::dvec3 angle = camera_numbers(values, "_angle");
    SavedCamera saved{.name = fmt::format("{}", record.id)};
    Camera& camera = saved.camera;
    camera.pitch_deg = std::clamp(-std::remainder(angle.x, 360.0), -90.0, 90.0);
    camera.yaw_deg = std::remainder(azimuth_of(angle.y) + 180.0, 360.0);
    const double fov = camera_numbers(values, "_fov").x;
    if (fov > 0.0 && fov < 180.0) camera.fov_y_deg = fov;
    const std::string* mode = find_value(values, "_mode");
    if (mode != nullptr && *mode == "pano") camera.projection = Projection::equirectangular;
    if (mode != nullptr && (*mode == "orth" || *mode == "iso")) {
        camera.projection = Projection::orthographic;
        saved.height = std::max(camera_numbers(values, "_frustum").x, 0.0);
    }
    const double reach = static_cast<double>(kMaxCoordinate) / 2.0;
    const glm::dvec3 focus = glm::clamp(camera_numbers(values, "_focus"), -reach, reach);
    const double radius = std::clamp(camera_numbers(values, "_radius").x, 0.0, reach);
    camera.position = focus - radius * camera_basis(camera)[2];
    return saved;
}

void note_cameras(const VoxFile& file, const Settings& settings) {
    for (const VoxRecord& record : file.cameras) {
        if (is_unused(record.attributes)) continue;
        if (camera_numbers(record.attributes, "_angle").z != 0.0)
            settings.note(fmt::format("camera {} is rolled, which is not shown", record.id));
        const std::string* mode = find_value(record.attributes, "_mode");
        static constexpr std::array<std::string_view, 5> kModes{"pers", "free", "pano", "orth", "iso"};
        if (mode != nullptr && std::ranges::find(kModes, *mode) == kModes.end())
            settings.note(fmt::format("camera {} has the projection {}, and is shown in perspective",
                                      record.id, quoted_name(*mode)));
    }
}

}  // namespace

std::vector<SavedCamera> saved_cameras(const VoxFile& file) {
    std::vector<SavedCamera> cameras;
    for (const VoxRecord& record : file.cameras) {
        if (is_unused(record.attributes)) continue;
        if (cameras.size() == kVoxMaxCameras) break;
        cameras.push_back(camera_of_record(record));
    }
    return cameras;
}

void apply_vox_settings(const VoxFile& file, std::span<const VoxDict> objects, Scene& scene) {
    const Settings settings(objects, scene);
    apply_sun(settings, scene.sun);
    apply_sky(settings, scene);
    apply_ground(settings, scene.ground);
    apply_background(settings, scene.background);
    apply_lens_and_film(settings, scene);
    note_what_is_not_shown(settings);
    note_cameras(file, settings);
    scene.cameras = saved_cameras(file);
}

}  // namespace voxilux
