#pragma once

#include <cstdint>
#include <vector>

#include "base/error.h"
#include "scene/scene.h"
#include "scene/vox_file.h"

namespace voxilux {

struct VoxInstance {
    std::uint32_t model = 0;  // index in VoxFile::models
    Rotation rotation;
    glm::ivec3 translation{0};        // as in Instance: about the pivot floor(size / 2)
    bool hidden = false;              // by a node above it or by a layer of one
    std::int32_t layer = -1;          // of the transform above it; -1: none
    std::uint32_t node = 0xFFFFFFFF;  // position in VoxFile::nodes of the transform above it, or none
};

// The instances that frame `frame` shows, hidden ones too, in the order of the file. A key frame holds from
// its number to the next; with _loop, numbers past the last key start again at the first. Without a graph
// every model has its low corner at the origin, and the models of a PACK file are shown one per frame. Fails
// as build_graph and parse_key do.
[[nodiscard]] Result<std::vector<VoxInstance>> vox_instances(const VoxFile& file, std::int64_t frame = 0);

// Without a graph: one instance of every model, its low corner at the origin.
[[nodiscard]] std::vector<VoxInstance> corner_instances(const VoxFile& file);

// Whether no axis goes beyond kVoxMaxTranslation.
[[nodiscard]] bool is_vox_translation(glm::i64vec3 translation);

// The name of the transform above the instance, or "". Valid as long as `file`.
[[nodiscard]] std::string_view instance_name(const VoxFile& file, const VoxInstance& instance);

// The key of `frames` (ascending or not) that holds at `frame`: the last one in the file whose number is not
// above it, else the first. With `loop`, `frame` is first taken into [first number, last number].
[[nodiscard]] std::size_t key_at(const std::vector<std::int64_t>& frames, std::int64_t frame, bool loop);

}  // namespace voxilux
