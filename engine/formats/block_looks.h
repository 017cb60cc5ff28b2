#pragma once

#include <cstdint>
#include <string_view>

#include "formats/voxel_cells.h"

namespace voxilux {

// How a block of Minecraft looks as one voxel.
struct BlockLook {
    glm::u8vec3 colour{128};  // sRGB
    CellLook look = CellLook::diffuse;
    bool is_empty = false;
    bool is_known = true;  // else the grey above

    bool operator==(const BlockLook&) const = default;
};

// By name and properties, "minecraft:oak_stairs[half=top]": air and what nobody sees are empty; a block that
// is switched off ("lit=false") gives no light. Shapes (stairs, slabs, panes) fill their whole cell. The
// colours are our own, close to the average of the block.
[[nodiscard]] BlockLook look_of_block(std::string_view name);

}  // namespace voxilux
