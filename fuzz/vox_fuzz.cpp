// libFuzzer target of the .vox reader. Property: whatever the bytes, read_vox stays within its memory bound
// and either refuses with a byte offset or returns a file that can be placed, summarised, made a scene,
// written, and read again with an equal result.

#include <cstdint>
#include <span>

#include "formats/vox_info.h"
#include "formats/vox_objects.h"
#include "formats/vox_read.h"
#include "formats/vox_write.h"
#include "require.h"
#include "scene/vox_instances.h"
#include "scene/vox_scene.h"
#include "scene/vox_settings.h"
#include "support/allocation_counter.h"

namespace {

// read_vox promises 64 MiB + 64 bytes per byte of the file. The fixed part is for tables; the largest is the
// 2 MiB set of cells, which doubles as it grows. The target allows less for them, so that small inputs can
// exceed the bound.
constexpr std::size_t kTableBytes = std::size_t{8} << 20;
constexpr std::size_t kBytesPerByte = 64;

void check_rewrite(const voxilux::VoxFile& file) {
    const auto bytes = voxilux::write_vox(file);
    auto again = voxilux::read_vox(bytes);
    require(again.ok(), "a written file is refused");
    voxilux::VoxFile second = std::move(again).value();
    require(voxilux::write_vox(second) == bytes, "a second write differs");
    second.warnings = file.warnings;  // they name bytes, and nothing needs repair twice
    require(second == file, "a written file reads back different");
}

void check_settings(const voxilux::VoxFile& file) {
    voxilux::Scene scene;
    voxilux::apply_vox_settings(file, voxilux::render_objects(file), scene);
    const glm::vec3 light = scene.sun.irradiance + scene.sky.radiance + scene.background.radiance;
    require(glm::all(glm::greaterThanEqual(light, glm::vec3(0.0f))) && light.x + light.y + light.z < 1e6f,
            "light is not finite");
    require(scene.framing_fov_y_deg > 0.0 && scene.framing_fov_y_deg < 180.0,
            "a field of view is out of range");
    for (const voxilux::SavedCamera& saved : scene.cameras) {
        const glm::dvec3 at = saved.camera.position;
        require(glm::length(at) < 4e9, "a camera is out of range");
        require(saved.camera.pitch_deg >= -90.0 && saved.camera.pitch_deg <= 90.0, "a camera is upside down");
    }
}

void check_scene(const voxilux::VoxFile& file, int frame) {
    const auto instances = voxilux::vox_instances(file, frame);
    const auto info = voxilux::summarize(file);
    if (info) require(!voxilux::describe(info.value()).empty(), "no description");
    if (!instances) {
        require(instances.reason().starts_with("node "), "a refusal names no node");
        return;
    }
    try {
        const voxilux::Scene scene = voxilux::scene_from_vox(file, {.frame = frame});
        require(scene.instances.size() <= instances.value().size(), "instances appeared");
        for (const auto& model : scene.models) {
            for (const auto& v : model.voxels) {
                require(v.x < model.size.x && v.y < model.size.y && v.z < model.size.z,
                        "a voxel is outside its model");
                require(v.material < scene.materials.size(), "a voxel has no material");
            }
        }
    } catch (const voxilux::Error& error) {
        require(error.code() == voxilux::ExitCode::input_refused, "a file is refused as something else");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto bytes = std::as_bytes(std::span(data, size));
    const PeakAllocation peak;
    const auto file = voxilux::read_vox(bytes);
    require(peak.bytes() <= kTableBytes + kBytesPerByte * size,
            "read_vox takes more memory than it promises");
    if (!file) {
        require(file.reason().starts_with("at byte "), "a refusal names no byte");
        return 0;
    }
    check_scene(file.value(), size > 0 ? static_cast<int>(data[size - 1]) - 8 : 0);
    check_settings(file.value());
    check_rewrite(file.value());
    return 0;
}
