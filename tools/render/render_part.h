#pragma once

#include <filesystem>
#include <optional>

#include "jobs/film_part.h"
#include "render/render.h"

namespace voxilux {

// Throws Error(usage) where --shard, --resume or --checkpoint do not go with the other flags.
void check_part_flags(const RenderCommand& command, const std::vector<std::string>& outputs);

// The shard that --shard names; the whole render without it.
[[nodiscard]] Shard shard_of(const RenderCommand& command);

// Where the checkpoint of a render lies: beside its first EXR. Nothing for a render that has none.
[[nodiscard]] std::optional<std::filesystem::path> checkpoint_file(const RenderCommand& command,
                                                                   const std::vector<std::string>& outputs);

// Adds to the options what checkpoints and parts need.
void set_part_options(const RenderCommand& command, const std::vector<std::string>& outputs,
                      RenderOptions& options);

// The outcome as a part, with the report that its picture has.
[[nodiscard]] FilmPart part_to_write(const RenderCommand& command, const Scene& scene, RenderOutcome outcome);

// Leaves a checkpoint of a render that stopped before its end.
void leave_checkpoint(const RenderCommand& command, const std::vector<std::string>& outputs,
                      const Scene& scene, const RenderOutcome& outcome);

// Removes the checkpoint of a render that is finished, and whose picture is written.
void remove_checkpoint(const RenderCommand& command, const std::vector<std::string>& outputs,
                       const RenderOutcome& outcome);

}  // namespace voxilux
