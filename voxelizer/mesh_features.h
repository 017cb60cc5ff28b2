#pragma once

// What mesh formats can express, and what happens to it here: one row for each extension of glTF in the
// Khronos registry and each keyword of MTL and OBJ. Nothing in a file is dropped silently: it is read, has no
// effect on a voxel, or is counted in a note, which --strict makes an error.

#include <cstdint>
#include <span>
#include <string_view>

#include "voxelizer/mesh_notes.h"

namespace voxilux {

enum class FeatureKind : std::uint8_t { gltf_extension, mtl_keyword, mtl_map_option, obj_keyword };

enum class FeatureFate : std::uint8_t {
    read,
    no_effect,  // metadata, or what no voxel can show
    fallback,   // the file has an equivalent that is read, or is refused if that is missing
    noted,      // left out or approximated: `said` says how
};

struct MeshFeature {
    FeatureKind kind = FeatureKind::gltf_extension;
    std::string_view name;
    FeatureFate fate = FeatureFate::read;
    std::string_view said = {};  // what a note says after the name
};

[[nodiscard]] std::span<const MeshFeature> mesh_features();

// The row of a name, or nullptr.
[[nodiscard]] const MeshFeature* find_feature(FeatureKind kind, std::string_view name);

// Counts `uses` of a feature that is not read exactly, or that has no row.
void note_feature(FeatureKind kind, std::string_view name, MeshNotes& notes, std::size_t uses = 1);

}  // namespace voxilux
