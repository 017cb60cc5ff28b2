#pragma once

#include "jobs/checkpoint.h"
#include "parse_values.h"
#include "scene_options.h"
#include "shared_flags.h"

namespace voxilux {

// The flags of render. plan takes them, too, to show what the same command line would do.
struct RenderCommand {
    SceneOptions scene;
    PictureFiles pictures;
    ReportOptions report;
    bool verbose = false;
    ProgressMode progress = ProgressMode::automatic;
    DeviceOptions device;
    glm::ivec2 group_size{8, 8};
    std::optional<double> time_limit_s;
    std::optional<double> error_target;
    std::optional<Shard> shard;
    SampleSet samples;                   // empty: all of them, or those of the shard
    std::optional<double> checkpoint_s;  // 0: none
    bool resume = false;
    bool denoises = false;
    std::string sheet;  // a contact sheet of all pictures
};

// Samples per pixel at which a render with --error and without --spp gives up.
inline constexpr std::uint32_t kMaxSamplesForError = 65536;

// Returns the flag of INPUT.
Flag add_render_flags(Flags& flags, RenderCommand& command);

// The pictures that a render writes: those asked for, else one PNG in the current folder with the name of the
// input. {name} stands for that name, {camera} for the camera's.
[[nodiscard]] PictureFiles pictures_of(const RenderCommand& command);

// `outputs`, numbered where flags ask for frames. Throws Error(usage) where the default name is taken by a
// file.
[[nodiscard]] std::vector<std::string> files_to_write(const RenderCommand& command,
                                                      const std::vector<std::string>& outputs);

// The checkpoint of a render. Throws Error(usage) where --samples, --shard, --resume or --checkpoint do not
// go with the other flags.
[[nodiscard]] Checkpoint checkpoint_of(const RenderCommand& command);

// The scene with the sample count of the flags: --error without --spp takes samples until the error is
// reached.
[[nodiscard]] Scene scene_to_render(const RenderCommand& command, StepTimes* times = nullptr);

// Whether only some of the samples are rendered, so that the EXR holds their sums.
[[nodiscard]] bool is_part(const RenderCommand& command);

// Tells the plan which samples of the scene the flags ask for. Throws Error(usage) when there are none.
void request_samples(const RenderCommand& command, const Scene& scene, PlanRequest& request);

// The render options of the flags, except for checkpoints (use_checkpoint).
[[nodiscard]] RenderOptions render_options(const RenderCommand& command);

// Renders and writes the pictures. Returns done, time_limit (before the error target) or interrupted.
[[nodiscard]] int run_render(const RenderCommand& command);

}  // namespace voxilux
