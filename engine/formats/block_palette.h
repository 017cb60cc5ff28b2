#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/block_looks.h"

namespace voxilux {

// Most states of blocks that the palettes of a file may hold; Minecraft has under 30000.
inline constexpr std::size_t kMaxBlockStates = std::size_t{1} << 16;

// The looks of blocks by their number in a file.
class BlockPalette {
  public:
    [[nodiscard]] bool empty() const { return states_.empty(); }
    // Throws VoxRefusal, which names `offset`, for one too many.
    void add(std::uint32_t number, std::string_view name, std::size_t offset);
    // After the last one is added; of equal numbers the last counts.
    void sort();
    // The look of a block that a cell holds, or nullptr.
    [[nodiscard]] const BlockLook* find(std::uint32_t number);
    // How many cells found an unknown block.
    void warn(std::vector<std::string>& warnings) const;

  private:
    struct State {
        std::uint32_t number = 0;
        BlockLook look;
    };
    std::vector<State> states_;
    std::size_t last_ = 0;  // found
    std::string unknown_;   // the first name
    std::uint64_t unknown_kinds_ = 0, unknown_cells_ = 0;
};

}  // namespace voxilux
