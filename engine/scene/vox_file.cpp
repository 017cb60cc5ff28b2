#include "scene/vox_file.h"

#include <algorithm>

#include "base/assert.h"

namespace voxilux {

const std::string* find_value(const VoxDict& dict, std::string_view key) {
    const auto found =
        std::find_if(dict.rbegin(), dict.rend(), [&](const auto& pair) { return pair.first == key; });
    return found == dict.rend() ? nullptr : &found->second;
}

VoxPalette default_vox_palette() {
    constexpr std::uint8_t kCube[] = {0xff, 0xcc, 0x99, 0x66, 0x33, 0x00};
    constexpr std::uint8_t kRamp[] = {0xee, 0xdd, 0xbb, 0xaa, 0x88, 0x77, 0x55, 0x44, 0x22, 0x11};
    VoxPalette palette{};
    std::size_t i = 0;
    for (const std::uint8_t r : kCube) {
        for (const std::uint8_t g : kCube) {
            for (const std::uint8_t b : kCube)
                palette[i++] = {r, g, b, 255};
        }
    }
    --i;  // the cube's last corner is black and is left out
    for (const std::uint8_t v : kRamp)
        palette[i++] = {v, 0, 0, 255};
    for (const std::uint8_t v : kRamp)
        palette[i++] = {0, v, 0, 255};
    for (const std::uint8_t v : kRamp)
        palette[i++] = {0, 0, v, 255};
    for (const std::uint8_t v : kRamp)
        palette[i++] = {v, v, v, 255};
    palette[i] = {};
    return palette;
}

VoxColour colour_of(const VoxFile& file, std::uint8_t index) {
    VX_ASSERT(index > 0);
    return file.palette[index - 1u];
}

}  // namespace voxilux
