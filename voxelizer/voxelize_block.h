#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "voxelizer/bin_triangles.h"
#include "voxelizer/cover_triangle.h"
#include "voxelizer/shade_triangle.h"
#include "voxelizer/whole_section.h"

namespace voxilux {

// A voxel on its way to the file: position in its model's 256^3 cells, sRGB colour, and look (see
// surface_look.h).
struct ColouredVoxel {
    std::uint8_t x = 0, y = 0, z = 0;
    std::uint8_t r = 0, g = 0, b = 0;
    std::uint16_t look = 0;

    bool operator==(const ColouredVoxel&) const = default;
};

enum class Coverage : std::uint8_t {
    conservative,  // every cell that the surface touches
    thin,          // 6-separating: cells whose central cross the surface meets
};

// What all blocks share.
struct VoxelizeInput {
    const Mesh& mesh;
    std::span<const glm::ivec3> lattice;       // positions, see lattice_positions
    std::span<const std::uint32_t> triangles;  // of all blocks, see Bins
    const MaterialSampler& sampler;
    const SectionTable& sections;
    Coverage coverage = Coverage::conservative;
};

// A run of cells along x that one triangle touches, in a block.
struct BlockSpan {
    std::uint16_t row = 0;  // y + 64 z
    std::uint8_t first = 0;
    std::uint8_t last = 0;
};

// What a voxel has accumulated from its pieces.
struct VoxelSum {
    glm::vec3 colour{0.0f};  // linear, times area, of pieces whose colours may be averaged with `look`'s
    float area = 0.0f;       // of these, voxels^2
    float votes = 0.0f;      // for `look`, minus those for others (R. Boyer and J. Moore, "MJRTY", 1981)
    std::uint16_t look = 0;
};

// Kept from block to block to reuse its memory.
struct BlockScratch {
    std::vector<std::uint64_t> filled;     // [64 z][64 y], bit x
    std::vector<std::uint64_t> touched;    // likewise; in thin mode more than `filled`
    std::vector<std::uint64_t> shared;     // likewise; touched by more than one triangle
    std::vector<std::uint32_t> first_sum;  // of each row of `filled`
    std::vector<BlockSpan> spans;          // by triangle
    std::vector<std::size_t> span_ends;    // of each triangle
    std::vector<VoxelSum> sums;
};

struct BlockResult {
    std::vector<ColouredVoxel> voxels;  // z by y by x
    std::size_t masked = 0;  // cells left empty because everything in them is below an alpha cutoff
};

// The voxels of a block. Depends only on its arguments: sums are in the order of the triangles.
[[nodiscard]] BlockResult voxelize_block(const VoxelizeInput& input, const Block& block,
                                         BlockScratch& scratch);

}  // namespace voxilux
