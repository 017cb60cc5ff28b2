#pragma once

#include "device_options.h"
#include "jobs/render_session.h"
#include "scene_options.h"

namespace voxilux {

// The flags of render, which plan takes too: it shows what the same command line would do.
struct RenderCommand {
    SceneOptions scene;
    std::vector<std::string> outputs;
    std::string json;
    DeviceOptions device;
    std::optional<std::string> time_limit;
    std::optional<std::string> error;
    std::optional<std::string> shard;
    std::optional<double> checkpoint_s;  // 0: none
    bool resume = false;
    std::string progress = "auto";
    std::string tone = "filmic";
    float exposure_ev = 0.0f;
    std::string group_size = "8x8";
    bool reproducible = false;
    bool quiet = false;
    bool verbose = false;
};

// Samples per pixel at which a render with --error and without --spp gives up.
inline constexpr std::uint32_t kMostSamplesForError = 65536;

void add_render_flags(CLI::App& command, RenderCommand& options);

CLI::App* add_render(CLI::App& app, RenderCommand& command);

// The pictures that a render writes: those asked for, else one PNG in the current folder with the name of the
// input. Throws Error(usage) for an ending that is neither .exr nor .png.
[[nodiscard]] std::vector<std::string> output_files(const RenderCommand& command);

// The scene as a render takes it. --error without --spp takes samples until the error is reached.
[[nodiscard]] Scene scene_to_render(const RenderCommand& command);

// The request that a render makes of the plan.
[[nodiscard]] PlanRequest request_of(const RenderCommand& command, const std::vector<std::string>& outputs);

// What the flags ask of a session, the options of parts included. `command` and `outputs` outlive them.
[[nodiscard]] RenderOptions render_options(const RenderCommand& command,
                                           const std::vector<std::string>& outputs);

// Renders and writes the pictures. Returns done, time_limit (before the error target) or interrupted.
[[nodiscard]] int run_render(const RenderCommand& command);

}  // namespace voxilux
