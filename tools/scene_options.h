#pragma once

// Flags that say what is drawn: common to the subcommands that read a scene.

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "frame_list.h"
#include "photon_options.h"
#include "plan/render_plan.h"
#include "scene/scene.h"

namespace voxilux {

// The flags as typed; empty where the user said nothing.
struct SceneOptions {
    std::string input;
    std::optional<std::string> size;
    std::optional<std::string> camera;
    std::optional<std::string> quality;
    std::optional<std::uint32_t> spp;
    std::optional<std::uint32_t> iterations;  // another name of spp
    PhotonOptions photons;
    std::optional<std::uint32_t> ao_rays;
    std::optional<float> ao_radius;
    std::optional<std::uint32_t> seed;
    std::optional<std::string> sequence;
    std::vector<std::string> effects;     // NAME=on|off|auto
    std::vector<std::string> techniques;  // EFFECT=NAME
    std::vector<std::string> overrides;   // -D key=value
    std::optional<std::int64_t> frame;    // one picture
    std::optional<std::string> frames;    // a picture for each
    std::optional<std::string> crop;
    std::optional<std::string> ao;
    std::optional<std::string> traversal;
    std::uint64_t memory_budget_mib = 0;
};

void add_scene_flags(CLI::App& command, SceneOptions& options);

// The scene with the flags applied. Throws Error(usage) for a flag that cannot be read, Error(input_refused)
// for a file.
[[nodiscard]] Scene load_scene_with(const SceneOptions& options);

// The frames to render. Without a flag, the first frame of an animated scene. Throws Error(usage) for
// --frames that cannot be read, and on a still scene.
[[nodiscard]] FrameList frames_to_render(const SceneOptions& options, const Scene& scene);

// Tells the plan how many frames will be rendered, and whether voxels move between them.
void request_frames(const Scene& scene, const FrameList& frames, PlanRequest& request);

// When an animated scene gives one picture only, because no flag names its frames: says so on standard error.
void print_frame_note(const SceneOptions& options, const Scene& scene);

// What the flags ask of the plan; the caller knows which channels its outputs hold.
[[nodiscard]] PlanRequest plan_request(const SceneOptions& options);

}  // namespace voxilux
