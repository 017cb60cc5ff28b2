#pragma once

// Cells of the ambient occlusion hash as a test sees them: read back from their keys, and found from
// positions in double precision, with independent code for both.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "shared/ao_cell.h"

namespace voxilux::test {

inline std::uint64_t key_bits(gpu::uvec2 key) {
    return std::uint64_t{key.y} << 32 | key.x;
}

inline gpu::uvec2 key_words(std::uint64_t bits) {
    return {static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32)};
}

inline std::uint64_t key_of(const gpu::AoCell& cell) {
    return key_bits(gpu::ao_cell_key(cell));
}

// The cell of a key, from the list of its bits; none when no cell has these bits.
inline std::optional<gpu::AoCell> cell_of_key(std::uint64_t key) {
    const auto field = [&](int first, int bits) {
        return static_cast<std::uint32_t>((key >> first) & ((std::uint64_t{1} << bits) - 1));
    };
    if (field(31, 1) == 0 || field(63, 1) == 0) return std::nullopt;
    gpu::AoCell cell{};
    cell.voxel = glm::ivec3(field(0, 17), field(17, 14) + (field(32, 3) << 14), field(35, 17));
    const std::uint32_t place = field(52, 11);
    cell.face = place / 341;
    if (cell.face > 5) return std::nullopt;
    std::uint32_t rest = place % 341;
    for (std::uint32_t parts = 1; rest >= parts * parts; parts *= 2) {
        rest -= parts * parts;
        ++cell.level;
    }
    cell.part = {rest % (1u << cell.level), rest >> cell.level};
    return cell;
}

// Axes of a face's coordinates.
inline int axis_u(std::uint32_t face) {
    return static_cast<int>(face / 2 + 1) % 3;
}
inline int axis_v(std::uint32_t face) {
    return static_cast<int>(face / 2 + 2) % 3;
}

// Level of a cell width in voxels: the binary exponent, which is exact.
inline std::uint32_t level_of(double width) {
    if (!(width > 0.0)) return gpu::kAoLevels - 1;
    return static_cast<std::uint32_t>(
        std::clamp(-std::ilogb(width), 0, static_cast<int>(gpu::kAoLevels) - 1));
}

// The cell of a level around a point of a voxel's face, in double.
inline gpu::AoCell cell_around(glm::ivec3 voxel, std::uint32_t face, glm::dvec3 fraction,
                               std::uint32_t level) {
    const double parts = std::ldexp(1.0, static_cast<int>(level));
    const auto part = [&](double place) {
        return static_cast<std::uint32_t>(std::min(std::floor(place * parts), parts - 1.0));
    };
    return {voxel, face, level, {part(fraction[axis_u(face)]), part(fraction[axis_v(face)])}};
}

}  // namespace voxilux::test
