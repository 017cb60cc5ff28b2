#include "view/scene_files.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/file.h"
#include "open_input.h"
#include "standard_streams.h"
#include "view/mesh_drop.h"
#include "view/picture_look.h"
#include "view/quality_choice.h"
#include "voxelizer/load_mesh.h"

namespace voxilux {
namespace {

constexpr glm::ivec2 kFirstSize{1280, 720};
constexpr int kFramesToSay = 2;  // a panel grows for a new line only in the frame after it

bool is_same_camera(const std::optional<Camera>& a, const std::optional<Camera>& b) {
    return a && b ? is_same_view(*a, *b) : a.has_value() == b.has_value();
}

// Among inputs, only scene files name a size; flags may, too.
bool names_size(const SceneOptions& options) {
    const auto is_size = [](const std::string& text) { return text.starts_with("render.size="); };
    return has_ending(options.input, ".toml") || options.names_size || options.pixels_per_voxel ||
           std::ranges::any_of(options.overrides, is_size);
}

}  // namespace

std::filesystem::path memory_file_of(const ViewCommand& command) {
    if (!command.state.empty()) return command.state;
    return command.script.empty() && !command.frames ? window_memory_file() : std::filesystem::path();
}

Scene first_scene(const ViewCommand& command, const WindowMemory& memory) {
    const bool has_input = !command.scene.input.empty();
    Scene scene;
    if (has_input)
        scene = load_scene_with(command.scene);
    else
        scene.settings.size = kFirstSize;
    if (memory.size.x > 0 && (!has_input || !names_size(command.scene))) scene.settings.size = memory.size;
    return scene;
}

void SceneFiles::show(Scene scene, const std::string& input, const FileWatch& watch) {
    const bool is_file = input != kStandardStream;
    const bool had_shadow_only = scene.ground.shadow_only;
    if (window_.size().x > 0) scene.settings.size = window_.size();
    const std::optional<Camera> own_camera = scene.camera;
    scene = window_scene(std::move(scene));
    Playback playback;
    const Scene& still = playback.load(scene, frames_to_render(command_.scene, scene).first);
    state_.picture.load(still, command_.scene.request);
    state_.picture.set_max_samples(scene.settings.spp);
    state_.input = input;
    state_.edit = {};
    state_.has_moved_sun = false;
    state_.had_shadow_only = had_shadow_only;
    state_.box = scene_bounds(still);
    state_.view = state_.home = view_of(*still.camera, state_.box);
    own_camera_ = own_camera;
    watch_ = is_file ? watch : FileWatch();
    playback_ = std::move(playback);
    playback_.start(state_);
    window_.set_title("voxilux " + state_.input.filename().string());
    const QualityPreset* const chosen = std::exchange(state_.quality, command_.scene.quality);
    if (chosen != nullptr && chosen != state_.quality) choose_quality(*chosen, state_);
    if (is_file) add_recent(state_.input, state_.memory);
    remember();
}

void SceneFiles::load(const std::string& file) {
    SceneOptions options = command_.scene;
    options.input = file;
    const FileWatch watch(file);  // begins before the file is read
    show(load_scene_with(options), file, watch);
}

// Keeps the view, unless the camera that the file names has changed.
void SceneFiles::reload() {
    state_.has_newer_file = false;
    try {
        const ViewPoint view = state_.view;
        const ViewPoint home = state_.home;
        const std::optional<Camera> own = own_camera_;
        load(state_.input.string());
        if (is_same_camera(own, own_camera_)) {
            state_.view = view;
            state_.home = home;
        }
        state_.message = "loaded again";
    } catch (const Error& error) {
        state_.message = error.what();
    }
}

void SceneFiles::open(const std::string& file) {
    try {
        if (has_ending(file, ".exr") || has_ending(file, ".png")) return take_reference(file);
        if (is_unsaved(state_.edit) && std::exchange(refused_, file) != file)
            throw Error(ExitCode::usage, "there are unsaved edits; opening the file once more discards them");
        refused_.clear();
        if (is_mesh(file)) {
            mesh_ = file;
            frames_to_say_ = kFramesToSay;
            state_.message = "voxelizing " + file;
            return;
        }
        load(file);
        state_.message.clear();
    } catch (const Error& error) {
        state_.message = error.what();
    }
}

void SceneFiles::finish_open() {
    if (mesh_.empty() || --frames_to_say_ > 0) return;
    try {
        const VoxelizedMesh made = voxelize_drop(std::exchange(mesh_, {}));
        load(made.file);
        state_.message = made.said;
    } catch (const Error& error) {
        state_.message = error.what();
    }
}

// The window takes the size of the image.
void SceneFiles::take_reference(const std::string& file) {
    const glm::ivec2 size = compare_with(file, state_);
    if (size != window_.size()) window_.resize(size);
}

void SceneFiles::follow() {
    if (!state_.file_to_open.empty()) open(std::exchange(state_.file_to_open, {}));
    if (std::exchange(state_.has_saved, false)) watch_.forgive();
    state_.has_newer_file |= watch_.has_changed();
    if (state_.has_newer_file && !is_unsaved(state_.edit)) reload();
}

void SceneFiles::play(double seconds) {
    if (state_.picture.is_loaded()) playback_.advance(seconds, state_);
}

void SceneFiles::remember() {
    if (window_.size().x > 0) state_.memory.size = window_.size();
    write_memory(memory_file_, state_.memory);
}

}  // namespace voxilux
