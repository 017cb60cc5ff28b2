#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "voxelizer/surface_look.h"
#include "voxelizer/voxelize_mesh.h"

namespace voxilux {

// How far the palette is from the colours of the voxels, dE76.
struct PaletteError {
    double mean = 0.0;
    double p95 = 0.0;
    double largest = 0.0;
    std::uint64_t radiances_off = 0;  // voxels whose emission is off by more than 3 %
};

struct PaletteEntry {
    glm::u8vec3 colour{0};
    Look look;
};

// Assigns one of at most 255 entries to each voxel. A voxel only takes an entry of its own look.
class VoxelPalette {
  public:
    // Built from all voxels of the surface. Exact when they have no more colours than entries; otherwise
    // colours are distinguished to 6 bits a channel and quantized. With `dither` a voxel takes one of two
    // entries on either side of its colour, depending on its position, so that means over a few voxels are
    // right.
    VoxelPalette(const VoxelSet& set, bool dither);

    [[nodiscard]] const std::vector<PaletteEntry>& entries() const { return entries_; }
    // In [0, entries().size()). `place` is the voxel's cell in the grid, for dithering.
    [[nodiscard]] std::uint8_t entry_of(const ColouredVoxel& voxel, glm::ivec3 place) const;
    // The entry of most voxels.
    [[nodiscard]] std::uint8_t commonest() const { return commonest_; }
    [[nodiscard]] const PaletteError& error() const { return error_; }

  private:
    // Colours of one look that agree in the upper 6 bits of each byte, or in all bits in a heavy slot.
    struct Cell {
        glm::u64vec3 sum{0};
        std::uint64_t count = 0;
        std::uint16_t look = 0;
        std::uint8_t entry = 0;
        std::uint8_t other = 0;       // with dithering: the entry on the other side
        std::uint8_t other_part = 0;  // of 256

        [[nodiscard]] glm::vec3 mean() const {
            return glm::vec3(glm::dvec3(sum) / static_cast<double>(count));
        }
    };

    void collect_looks(const VoxelSet& set);
    [[nodiscard]] bool make_exact(const VoxelSet& set);
    void find_heavy_slots(const VoxelSet& set);
    void count_cells(const VoxelSet& set);
    void quantize(const VoxelSet& set);
    void settle_colours();
    void find_dither_pairs();
    void add_exact(std::uint64_t key);
    void measure(const VoxelSet& set, bool dither);
    [[nodiscard]] std::size_t coarse_slot_of(const ColouredVoxel& voxel) const;
    [[nodiscard]] std::size_t slot_of(const ColouredVoxel& voxel) const;

    std::vector<std::uint8_t> group_of_look_;  // of a look's 16 bits
    std::vector<Look> looks_;                  // of each group
    // Slot: group, then 6 bits each of r, g, b; each heavy slot has 64 finer ones after all others. Values
    // are the index of a cell, 0 for none, or kHeavy and the first finer slot.
    std::vector<std::uint32_t> cell_of_slot_;
    std::vector<Cell> cells_;                // the first is unused
    std::vector<std::uint64_t> exact_keys_;  // hash table of look and colour, when there are few
    std::vector<std::uint8_t> exact_entries_;
    std::vector<PaletteEntry> entries_;
    std::uint8_t commonest_ = 0;
    PaletteError error_;
};

}  // namespace voxilux
