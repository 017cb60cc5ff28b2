#include "open_input.h"

#include <algorithm>

#include "base/error.h"
#include "base/print.h"
#include "formats/scene_toml.h"
#include "formats/vox_read.h"
#include "parse_values.h"
#include "plan/techniques.h"
#include "scene/facts.h"
#include "scene/scene_camera.h"
#include "scene/settings.h"
#include "standard_streams.h"
#include "voxelizer/import_voxels.h"

namespace voxilux {
namespace {

bool sends_photons(const Scene& scene, const SceneOptions& options) {
    RenderSettings settings = scene.settings;
    choose_techniques(options.techniques, settings);
    const SceneFacts facts = measure_scene(scene);
    const EffectStates effects = decide_effects(facts, with_techniques(options.request.effects, settings));
    return std::ranges::any_of(
        choose_techniques(effects, {}, settings, facts.has_specular_spheres, facts.has_rough),
        [](const ChosenTechnique& chosen) { return chosen.technique->by_photons; });
}

// Samples of the preset in a scene with photons, unless an override says how many.
void set_iterations_of_quality(const SceneOptions& options, Scene& scene) {
    if (options.quality == nullptr) return;
    const auto sets_samples = [](const std::string& text) { return text.starts_with("render.spp="); };
    if (std::ranges::none_of(options.overrides, sets_samples) && sends_photons(scene, options))
        scene.settings.spp = options.quality->photons.samples;
}

Camera saved_camera(const Scene& scene, const std::string& name) {
    const auto saved = std::ranges::find(scene.cameras, name, &SavedCamera::name);
    if (saved == scene.cameras.end()) {
        std::vector<std::string> names;
        for (const SavedCamera& one : scene.cameras)
            names.push_back(one.name);
        throw Error(ExitCode::usage,
                    fmt::format("--camera: there is no '{}'; known are three-quarter, front, back, left, "
                                "right, top, bottom, iso{}{}",
                                name, names.empty() ? "" : ", and of the file ", fmt::join(names, ", ")));
    }
    Camera camera = saved->camera;
    if (camera.projection == Projection::orthographic) {
        if (saved->height == 0.0) return framing_camera(scene, camera);
        camera.pixels_per_voxel = std::min(scene.settings.size.y / saved->height, kMaxPixelsPerVoxel);
    }
    return camera;
}

// The camera that flags ask for: its place, or only the lens with which it frames the scene.
void apply_camera_flags(const SceneOptions& options, Scene& scene) {
    if (!options.camera && !options.projection && !options.pixels_per_voxel) return;
    const bool is_saved = options.camera && !options.camera->side;
    if (is_saved) scene.camera = saved_camera(scene, options.camera->name);
    if (is_saved) scene.animation.camera_keys.clear();
    if (is_saved && !options.projection && !options.pixels_per_voxel) return;
    const Camera own = scene.camera.value_or(looking_along(View::three_quarter, scene.framing_fov_y_deg));
    const bool is_side = options.camera && options.camera->side;
    Camera looking = is_side ? looking_along(*options.camera->side, own.fov_y_deg) : own;
    looking.projection = options.projection.value_or(own.projection);
    looking.pixels_per_voxel = own.pixels_per_voxel;
    if (options.pixels_per_voxel) {
        if (options.projection.value_or(Projection::orthographic) != Projection::orthographic)
            refuse("--pixels-per-voxel is of orthographic pictures");
        looking.projection = Projection::orthographic;
        looking.pixels_per_voxel = *options.pixels_per_voxel;
        if (!options.names_size) scene.settings.size = sprite_size(scene, looking);
    }
    scene.animation.camera_keys.clear();
    scene.camera = framing_camera(scene, looking);
}

// --viewpoint, with the lens of the other flags.
Camera viewpoint_of(const SceneOptions& options) {
    Camera camera = *options.viewpoint;
    const Projection scaled = options.pixels_per_voxel ? Projection::orthographic : Projection::perspective;
    camera.projection = options.projection.value_or(scaled);
    camera.pixels_per_voxel = options.pixels_per_voxel.value_or(0.0);
    if (camera.projection == Projection::orthographic && !options.pixels_per_voxel)
        refuse("--viewpoint with an orthographic --projection needs --pixels-per-voxel");
    return camera;
}

// Standard input: a .vox file by its first bytes, else the text of a scene, whose files lie in this folder.
Scene open_standard_input(const LoadOptions& load) {
    constexpr std::string_view kName = "standard input";
    const std::vector<std::byte> bytes = read_standard_input();
    if (bytes.empty()) throw Error(ExitCode::input_refused, fmt::format("{} is empty", kName));
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (!text.starts_with("VOX ")) return parse_scene(text, kName, load);
    const auto vox = read_vox(bytes);
    if (!vox) throw Error(ExitCode::input_refused, fmt::format("{}: {}", kName, vox.reason()));
    if (load.times != nullptr) load.times->end_step("read");
    return scene_of_file(vox.value(), kName, load);
}

// The one place where inputs are opened.
Scene open_input(const SceneOptions& options, const LoadOptions& load, bool says_notes) {
    if (options.input == kStandardStream) return open_standard_input(load);
    if (!is_importable(options.input)) return load_scene(options.input, load);
    const ImportedVoxels imported = import_voxels(options.input, options.grid);
    if (load.times != nullptr) load.times->end_step("read");
    if (says_notes) print_message("note: {}\n", imported.note);
    return scene_of_file(imported.file, options.input, load);
}

}  // namespace

Scene load_scene_with(const SceneOptions& options, bool says_notes, StepTimes* times) {
    // -D comes after the preset, so that it wins.
    std::vector<std::string> overrides;
    if (options.quality != nullptr) overrides = overrides_of(*options.quality);
    overrides.insert(overrides.end(), options.overrides.begin(), options.overrides.end());
    Scene scene = open_input(
        options,
        {.overrides = overrides, .ignores_file_settings = options.ignores_file_settings, .times = times},
        says_notes);
    set_iterations_of_quality(options, scene);
    for (const auto& change : options.changes)
        change(scene.settings);
    choose_techniques(options.techniques, scene.settings);
    scene.settings.spp = options.spp.value_or(scene.settings.spp);
    if (options.background) scene.background = *options.background;
    if (options.turntable) {
        scene.animation.turntable = Turntable{.frames = *options.turntable, .turned = options.turned};
        scene.animation.camera_keys.clear();
    } else if (options.turned != Turned::camera) {
        refuse("--turn needs --turntable");
    }
    apply_camera_flags(options, scene);
    if (options.viewpoint) {
        scene.camera = viewpoint_of(options);
        scene.animation.camera_keys.clear();
        scene.animation.turntable.reset();
    }
    return scene;
}

}  // namespace voxilux
