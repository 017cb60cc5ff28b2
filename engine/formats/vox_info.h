#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "base/error.h"
#include "scene/scene.h"
#include "scene/vox_file.h"

namespace voxilux {

using VoxBox = std::pair<glm::ivec3, glm::ivec3>;  // lowest cell, one past the highest

// What `voxilux info` says about a .vox file. Instances are those of frame 0, hidden ones too; a file without
// a graph has one per model.
struct VoxInfo {
    std::int32_t version = 0;
    std::size_t models = 0;
    std::vector<glm::ivec3> sizes;
    std::uint64_t voxels = 0;  // stored entries, with duplicates and empty ones
    std::size_t instances = 0;
    std::size_t hidden_instances = 0;
    std::uint64_t instanced_voxels = 0;
    std::size_t layers = 0;
    std::size_t cameras = 0;
    std::map<std::string, std::size_t> materials;  // MATL by _type, "(none)" without one
    std::size_t old_materials = 0;                 // MATT
    std::size_t max_frames = 0;                    // most key frames of a transform
    std::size_t max_models_per_shape = 0;
    bool has_palette = false;
    bool has_imap = false;
    std::size_t colours_used = 0;     // distinct indices stored, 0 too
    std::optional<VoxBox> scene_box;  // of the sizes of all instances
    std::optional<VoxBox> voxel_box;  // of their voxels
    std::uint64_t out_of_size = 0;
    std::uint64_t duplicates = 0;
    std::uint64_t index0 = 0;
    std::map<std::string, std::size_t> unknown_chunks;  // by id
    std::vector<VoxDict> settings;                      // render_objects()
    std::vector<SavedCamera> saved_cameras;             // those that were set
    std::vector<std::string> warnings;
};

// Fails when the file's graph cannot be walked, as vox_instances does.
[[nodiscard]] Result<VoxInfo> summarize(const VoxFile& file);

// The object that `voxilux info FILE.vox --json -` prints; `sizes` are those of the first kInfoSizes models.
inline constexpr std::size_t kInfoSizes = 12;
[[nodiscard]] nlohmann::json to_json(const VoxInfo& info);

// The same for people: one line per fact.
[[nodiscard]] std::string describe(const VoxInfo& info);

}  // namespace voxilux
