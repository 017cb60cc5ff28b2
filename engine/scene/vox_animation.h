#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"
#include "scene/vox_file.h"

namespace voxilux {

// The first and the last of the frames first, first + 1, ... last.
struct FrameRange {
    std::int64_t first = 0;
    std::int64_t last = 0;

    bool operator==(const FrameRange&) const = default;
};

// No frame number is above it: 1,000,000 frames are nine hours at 30 a second.
inline constexpr std::int64_t kMaxFrame = 1'000'000;

// Whether a frame of the file may differ from another: a transform has several keys, a shape several models,
// or a PACK file, whose models are frames, more than one.
[[nodiscard]] bool is_animated(const VoxFile& file);

// The frames of an animated file, within [0, kMaxFrame]: what META's _anim_range says, else from its first
// key to its last.
[[nodiscard]] FrameRange frames_of(const VoxFile& file);

// The numbers of all key frames within frames_of(file), rising, each once.
[[nodiscard]] std::vector<std::int64_t> key_frames_of(const VoxFile& file);

// The file without what frames have in common: what vox_instances needs, and nothing else.
[[nodiscard]] VoxFile graph_of(const VoxFile& file);

}  // namespace voxilux
