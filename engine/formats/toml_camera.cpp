// [camera]: where the camera stands, or its keys [[camera.key]], or its [camera.turntable].

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "formats/toml_scene.h"
#include "formats/toml_section.h"
#include "scene/animation.h"
#include "scene/scene_bounds.h"
#include "scene/scene_camera.h"

namespace voxilux {
namespace {

constexpr Range kPlace{-kMaxCoordinate, kMaxCoordinate};
constexpr Range kFov{0.0, 180.0, true, true};

bool names_direction(const TomlSection& section) {
    return section.has("look_at") || section.has("yaw") || section.has("pitch");
}

Camera placed_camera(const TomlSection& section, glm::dvec3 position, double fov_y_deg) {
    const auto look_at = section.numbers3("look_at", kPlace);
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
    const Camera camera = framing_camera(in.scene, view, fov_y_deg);
    if (!(glm::length(camera.position) <= kMaxCoordinate))
        section.refuse("fov", "is so narrow that the whole scene fits only from beyond 2^30 voxels away");
    return camera;
}

CameraKey read_key(const toml::node& node, double fov_y_deg) {
    if (!node.is_table())
        refuse_at(node.source(), "'key' must be sections [[camera.key]] in double brackets");
    const TomlSection section(*node.as_table(), "[[camera.key]]",
                              {"frame", "position", "look_at", "yaw", "pitch", "fov"});
    CameraKey key{.frame = section.require(section.integer("frame", 0, kMaxFrame), "frame")};
    const glm::dvec3 position = section.require(section.numbers3("position", kPlace), "position");
    key.camera = placed_camera(section, position, section.number("fov", kFov).value_or(fov_y_deg));
    key.look_at = section.numbers3("look_at", kPlace);
    return key;
}

void read_keys(TomlScene& in, const TomlSection& section, double fov_y_deg) {
    for (const std::string_view key : {"position", "look_at", "yaw", "pitch", "preset", "turntable"}) {
        if (section.has(key)) section.refuse(key, "excludes [[camera.key]]: the keys place the camera");
    }
    const toml::node& list = *section.find("key");
    if (!list.is_array()) section.refuse("key", "must be sections [[camera.key]] in double brackets");
    std::vector<CameraKey>& keys = in.scene.animation.camera_keys;
    for (const toml::node& node : *list.as_array()) {
        const CameraKey key = read_key(node, fov_y_deg);
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
    const TomlSection section(*node.as_table(), "[camera.turntable]", {"frames", "degrees", "start"});
    Turntable turntable{.frames = section.require(section.integer("frames", 1, kMaxFrame), "frames")};
    const Range turn{-kMaxTurn, kMaxTurn};
    turntable.degrees = section.number("degrees", turn).value_or(turntable.degrees);
    turntable.start_deg = section.number("start", turn).value_or(turntable.start_deg);
    if (turntable.degrees == 0.0) section.refuse("degrees", "must not be 0: the camera would stand");
    in.scene.animation.turntable = turntable;
}

}  // namespace

void read_camera(TomlScene& in) {
    const toml::table* table = find_section(in, "camera");
    if (table == nullptr) return;
    const TomlSection section(
        *table, "[camera]",
        {"position", "look_at", "yaw", "pitch", "fov", "preset", "path", "key", "turntable"});
    constexpr std::array<std::string_view, 7> kViews{
        "three_quarter", "front", "back", "left", "right", "top", "iso"};  // in the order of View
    constexpr std::array<std::string_view, 2> kPaths{"smooth", "linear"};  // in the order of CameraPath
    const auto fov = section.number("fov", kFov);
    if (const auto path = section.choice("path", kPaths)) {
        if (!section.has("key")) section.refuse("path", "needs [[camera.key]]");
        in.scene.animation.camera_path = static_cast<CameraPath>(*path);
    }
    if (section.has("key")) return read_keys(in, section, fov.value_or(kDefaultFovYDeg));
    if (section.has("turntable")) read_turntable(in, section);
    const auto view = section.choice("preset", kViews);
    const auto position = section.numbers3("position", kPlace);
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
