#pragma once

// The properties of a voxel besides its colour, in 16 bits, so that a voxel with colour and look fits 8
// bytes. Properties are rounded to a few steps, because each look needs entries of its own in the palette of
// 255.

#include <compare>
#include <cstdint>

#include "scene/vox_file.h"
#include "voxelizer/mesh.h"
#include "voxelizer/mesh_notes.h"
#include "voxelizer/texture_sample.h"

namespace voxilux {

enum class LookKind : std::uint8_t { diffuse, metal, glass, emit };

struct Look {
    LookKind kind = LookKind::diffuse;
    std::uint8_t rough = 0;  // 0..7: roughness in sevenths (metal, glass)
    std::uint8_t level = 0;  // glass: 0..15, transparency in fifteenths; emit: 0..38, see emission_of
    std::uint8_t ior = 0;    // 0..15: glass: 1 + ior / 10

    auto operator<=>(const Look&) const = default;
};

// The emission of a material as a .vox file can hold it; values out of range are noted. Radiance 1 is that of
// a white surface under a plain sky.
[[nodiscard]] glm::vec3 emission_in_range(glm::dvec3 radiance, MeshNotes& notes);

// The look of a material with this value: emission takes precedence over glass (BLEND, transmission), and
// that over metal.
[[nodiscard]] Look look_of(const MeshMaterial& material, const SurfaceColor& value);

[[nodiscard]] std::uint16_t packed(const Look& look);
[[nodiscard]] Look unpacked(std::uint16_t bits);

// A look with fewer steps: roughness and transparency rounded to every 2nd, 4th, ... step. The refractive
// index and the emission stay, because a mesh has few of them.
[[nodiscard]] Look coarser(const Look& look, int halvings);

// The attributes of a MATL chunk; our reader and MagicaVoxel's take the colour from the palette.
[[nodiscard]] VoxDict material_attributes(const Look& look);

// Radiance / colour of an emitting look: 2^(level - 12), at most what the reader accepts.
[[nodiscard]] float emission_of(const Look& look);

// The colour of a voxel with this look, linear: its emission divided by emission_of, else the base colour.
[[nodiscard]] glm::vec3 colour_of(const Look& look, const SurfaceColor& value);

// Whether colours of two packed looks have the same meaning, so that they may be averaged.
[[nodiscard]] bool share_colours(std::uint16_t a, std::uint16_t b);

}  // namespace voxilux
