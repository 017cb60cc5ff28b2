// [camera]: where the camera stands, or its keys [[camera.key]], or its [camera.turntable].

#include <fmt/format.h>

#include "formats/toml_scene.h"
#include "scene/animation.h"
#include "scene/scene_camera.h"

namespace voxilux {
namespace {

void check_fov(const TomlSection& section, Projection projection, double fov_y_deg) {
    if (fov_y_deg >= 180.0 && projection != Projection::fisheye)
        section.refuse("fov",
                       fmt::format("must be below 180 unless the projection is fisheye, not {}", fov_y_deg));
}

Camera lens_of(const TomlSection& section, const CameraSettings& camera) {
    const bool is_scaled = camera.pixels_per_voxel.has_value();
    if (is_scaled && section.has("projection") && camera.projection != Projection::orthographic)
        section.refuse("pixels_per_voxel", "needs projection = \"orthographic\"");
    return {.fov_y_deg = camera.placement.fov_y_deg,
            .projection = is_scaled ? Projection::orthographic : camera.projection,
            .pixels_per_voxel = camera.pixels_per_voxel.value_or(0.0)};
}

bool names_direction(const CameraPlacement& placement) {
    return placement.look_at || placement.yaw_deg || placement.pitch_deg;
}

// `lens`: what all keys of a camera share.
Camera placed_camera(const TomlSection& section, const CameraPlacement& placement, const Camera& lens) {
    const auto& [position, look_at, yaw_deg, pitch_deg, fov_y_deg] = placement;
    if (look_at && (yaw_deg || pitch_deg))
        section.refuse("look_at", "excludes 'yaw' and 'pitch': give one or the other");
    if (!look_at && !(yaw_deg && pitch_deg))
        section.refuse("with 'position' needs 'look_at', or 'yaw' and 'pitch'");
    if (look_at && *look_at == *position) section.refuse("look_at", "must differ from 'position'");
    const YawPitch direction = look_at ? yaw_pitch_of(*look_at - *position) : YawPitch{*yaw_deg, *pitch_deg};
    if (lens.projection == Projection::orthographic && lens.pixels_per_voxel == 0.0)
        section.refuse("with 'position' and projection = \"orthographic\" needs 'pixels_per_voxel'");
    check_fov(section, lens.projection, fov_y_deg);
    return {*position, direction.yaw_deg, direction.pitch_deg,
            fov_y_deg, lens.projection,   lens.pixels_per_voxel};
}

Camera framing(TomlScene& in, const TomlSection& section, View view, const Camera& lens) {
    check_fov(section, lens.projection, lens.fov_y_deg);
    Camera looking = looking_along(view, lens.fov_y_deg);
    looking.projection = lens.projection;
    looking.pixels_per_voxel = lens.pixels_per_voxel;
    const toml::table* render = find_section(in, "render");
    const bool has_size = render != nullptr && render->contains("size");
    if (lens.pixels_per_voxel > 0.0 && !has_size) in.scene.settings.size = sprite_size(in.scene, looking);
    const Camera camera = framing_camera(in.scene, looking);
    if (!(glm::length(camera.position) <= kMaxCoordinate))
        section.refuse("fov", "is so narrow that the whole scene fits only from beyond 2^30 voxels away");
    return camera;
}

CameraKey read_key(const toml::node& node, const Camera& lens) {
    if (!node.is_table())
        refuse_at(node.source(), "'key' must be sections [[camera.key]] in double brackets");
    CameraKeySettings key{.placement = {.fov_y_deg = lens.fov_y_deg}};
    const TomlSection section = read_settings(*node.as_table(), "[[camera.key]]", key);
    (void)section.require(key.placement.position, "position");
    return {key.frame, placed_camera(section, key.placement, lens), key.placement.look_at};
}

void read_keys(TomlScene& in, const TomlSection& section, const Camera& lens) {
    for (const std::string_view key : {"position", "look_at", "yaw", "pitch", "preset", "turntable"}) {
        if (section.has(key)) section.refuse(key, "excludes [[camera.key]]: the keys place the camera");
    }
    const toml::node& list = *section.find("key");
    if (!list.is_array()) section.refuse("key", "must be sections [[camera.key]] in double brackets");
    std::vector<CameraKey>& keys = in.scene.animation.camera_keys;
    for (const toml::node& node : *list.as_array()) {
        const CameraKey key = read_key(node, lens);
        if (!keys.empty() && key.frame <= keys.back().frame)
            refuse_at(
                node.as_table()->get("frame")->source(),
                fmt::format("'frame' in [[camera.key]] must be above {}, that of the key before, not {}",
                            keys.back().frame, key.frame));
        keys.push_back(key);
    }
    if (keys.size() < 2) section.refuse("needs two [[camera.key]] or more; a camera that stands needs none");
    in.scene.camera = keys.front().camera;
}

void read_turntable(TomlScene& in, const TomlSection& camera) {
    const toml::node& node = *camera.find("turntable");
    if (!node.is_table()) camera.refuse("turntable", "must be a section [camera.turntable]");
    Turntable& turntable = in.scene.animation.turntable.emplace();
    const TomlSection section = read_settings(*node.as_table(), "[camera.turntable]", turntable);
    if (turntable.degrees == 0.0) section.refuse("degrees", "must not be 0: the camera would stand");
}

// A pinhole has no focus.
Lens completed(const TomlSection& section, Lens lens, const Scene& scene) {
    if (lens.focus && lens.focus_at) section.refuse("focus_at", "excludes 'focus': give one or the other");
    if (lens.aperture == 0.0) return {};
    if (lens.focus || lens.focus_at) return lens;
    const Box box = bounds_of_frames(scene);
    lens.focus_at = box.empty() ? glm::dvec3(0.0) : 0.5 * (glm::dvec3(box.lo) + glm::dvec3(box.hi));
    return lens;
}

}  // namespace

void read_camera(TomlScene& in) {
    const toml::table* table = find_section(in, "camera");
    if (table == nullptr) return;
    CameraSettings camera;
    camera.placement.fov_y_deg = in.scene.framing_fov_y_deg;
    const TomlSection section = read_settings(*table, "[camera]", camera, {"key", "turntable"});
    const auto& [placement, preset, path, projection, pixels_per_voxel, aperture] = camera;
    const Camera lens = lens_of(section, camera);
    in.scene.lens = completed(section, aperture, in.scene);
    if (section.has("path") && !section.has("key")) section.refuse("path", "needs [[camera.key]]");
    in.scene.animation.camera_path = path;
    if (section.has("key")) return read_keys(in, section, lens);
    if (section.has("turntable")) read_turntable(in, section);
    if (preset && (placement.position || names_direction(placement)))
        section.refuse("preset", "excludes 'position', 'look_at', 'yaw' and 'pitch'");
    if (!placement.position && names_direction(placement)) section.refuse("needs 'position' or 'preset'");
    if (placement.position)
        in.scene.camera = placed_camera(section, placement, lens);
    else if (preset || section.has("fov") || lens.projection != Projection::perspective)
        in.scene.camera = framing(in, section, preset.value_or(View::three_quarter), lens);
}

}  // namespace voxilux
