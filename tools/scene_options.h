#pragma once

// Flags that say what is drawn: common to the subcommands that read a scene.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "camera_choice.h"
#include "flags.h"
#include "jobs/frame_list.h"
#include "plan/render_plan.h"
#include "quality.h"
#include "scene/scene.h"
#include "scene/scene_camera.h"
#include "technique_flag.h"
#include "voxelizer/mesh_grid.h"

namespace voxilux {

// Changes of the scene's settings that flags ask for.
using SettingsChanges = std::vector<std::function<void(RenderSettings&)>>;

struct SceneOptions {
    std::string input;
    const VoxFile* voxels = nullptr;  // instead of the file: voxels in memory, which `input` only names
    GridRequest grid;                 // of a mesh
    const QualityPreset* quality = nullptr;
    std::vector<std::string> overrides;  // -D: KEY=VALUE of a scene file
    SettingsChanges changes;
    std::vector<NamedTechnique> techniques;
    std::optional<std::uint32_t> spp;  // or iterations
    std::vector<std::string> inputs;   // of a render that takes several; `input` is the first
    std::optional<CameraChoice> camera;
    std::vector<CameraChoice> cameras;  // likewise
    std::optional<Camera> viewpoint;
    std::optional<Background> background;
    bool ignores_file_settings = false;
    std::optional<Projection> projection;
    std::optional<double> pixels_per_voxel;
    bool names_size = false;
    std::optional<std::int64_t> frame;      // one picture
    std::optional<FrameList> frames;        // a picture for each
    std::optional<std::int64_t> turntable;  // of so many pictures, without [camera.turntable]
    Turned turned = Turned::camera;
    PlanRequest request;  // the caller sets the channels that its outputs hold
};

// What a subcommand renders of a scene: one picture, a picture for each frame (--frames), or a picture for
// each of several inputs and cameras, too.
enum class PicturesOf : std::uint8_t { scene, frames, inputs };

// Returns the flag of INPUT.
Flag add_scene_flags(Flags& flags, SceneOptions& options, PicturesOf pictures = PicturesOf::frames);

// --photons, --radius and --alpha.
void add_photon_flags(Flags& flags, SettingsChanges& changes);

// Whether flags ask for several frames: a range, or a whole turntable.
[[nodiscard]] bool asks_for_frames(const SceneOptions& options);

// The frames that flags name; else one picture without a number.
[[nodiscard]] FrameList frames_asked_for(const SceneOptions& options);

// The frames to render. Without a flag, the first frame of an animated scene. Throws Error(usage) for
// --frames on a still scene.
[[nodiscard]] FrameList frames_to_render(const SceneOptions& options, const Scene& scene);

// Sets in the plan's request how many frames will be rendered, and whether voxels move between them.
void request_frames(const Scene& scene, const FrameList& frames, PlanRequest& request);

// Says on standard error that an animated scene gives one picture only, because no flag names its frames.
void print_frame_note(const SceneOptions& options, const Scene& scene);

}  // namespace voxilux
