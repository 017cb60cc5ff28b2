#include "scene/terrain.h"

#include <algorithm>
#include <vector>

#include "shared/hash.h"

namespace voxilux {
namespace {

// Fixed point with 16 fraction bits.
constexpr int kFraction = 16;
constexpr std::int64_t kOne = std::int64_t{1} << kFraction;

constexpr int kOctaves = 4;

std::int64_t floor_div(std::int64_t a, std::int64_t b) {
    return a / b - (a % b < 0 ? 1 : 0);
}

// 3 t^2 - 2 t^3 for t in [0, 1].
std::int64_t smooth(std::int64_t t) {
    return (t * t * (3 * kOne - 2 * t)) >> (2 * kFraction);
}

// a at t = 0, b at t = 1.
std::int64_t blend(std::int64_t a, std::int64_t b, std::int64_t t) {
    return a + (((b - a) * t) >> kFraction);
}

// In [0, 1).
std::int64_t lattice_height(std::int64_t i, std::int64_t j, std::uint32_t octave, std::uint32_t seed) {
    return gpu::hash4(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), octave, seed) >> 16;
}

// Adds an octave to the sums of the columns x, x + 1, ... of a row. Heights of the lattice are looked up once
// for each of its cells, and weights are computed once for each place in a cell.
void add_octave(const TerrainShape& terrain, std::uint32_t octave, int x, int y,
                std::span<std::int64_t> sums) {
    const std::int64_t cell = std::max(1, terrain.feature >> octave);
    const auto count = static_cast<std::int64_t>(sums.size());
    std::int64_t i = floor_div(x, cell);
    const std::int64_t j = floor_div(y, cell);
    const std::int64_t ty = smooth((y - j * cell) * kOne / cell);
    const std::int64_t start = x - i * cell;
    std::vector<std::int64_t> tx(static_cast<std::size_t>(std::min(cell, count)));
    for (std::size_t k = 0; k < tx.size(); ++k)
        tx[k] = smooth((start + static_cast<std::int64_t>(k)) % cell * kOne / cell);
    const auto height = [&](std::int64_t di, std::int64_t dj) {
        return lattice_height(i + di, j + dj, octave, terrain.seed);
    };
    std::size_t place = 0;
    for (std::int64_t k = 0; k < count; ++i) {
        const std::int64_t h00 = height(0, 0), h10 = height(1, 0), h01 = height(0, 1), h11 = height(1, 1);
        const std::int64_t end = std::min(count, (i + 1) * cell - x);
        for (; k < end; ++k) {
            const std::int64_t t = tx[place];
            place = place + 1 == static_cast<std::size_t>(cell) ? 0 : place + 1;
            sums[static_cast<std::size_t>(k)] += blend(blend(h00, h10, t), blend(h01, h11, t), ty)
                                                 << (kOctaves - 1 - octave);
        }
    }
}

// 1 in the middle of the range, 0 at its ends: 1 - u^2.
std::int64_t arch(std::int64_t at, std::int64_t from, std::int64_t to) {
    const std::int64_t u = (2 * (at - from) + 1) * kOne / (to - from) - kOne;
    return kOne - ((u * u) >> kFraction);
}

}  // namespace

void terrain_heights(const TerrainShape& terrain, int x, int y, std::span<int> heights) {
    std::vector<std::int64_t> sums(heights.size(), 0);
    for (std::uint32_t octave = 0; octave < kOctaves; ++octave)
        add_octave(terrain, octave, x, y, sums);
    const std::int64_t cells = std::int64_t{terrain.to.z} - terrain.from.z;
    const std::int64_t arch_y = terrain.island ? arch(y, terrain.from.y, terrain.to.y) : 0;
    for (std::size_t k = 0; k < heights.size(); ++k) {
        // The weights are 8, 4, 2, 1. Sums of noise crowd around the middle: the stretch makes plains and
        // peaks.
        const std::int64_t mean = sums[k] / ((1 << kOctaves) - 1);
        std::int64_t height = std::clamp<std::int64_t>((16 * mean - 4 * kOne) / 8, 0, kOne);
        if (terrain.island) {
            const std::int64_t at = std::int64_t{x} + static_cast<std::int64_t>(k);
            const std::int64_t middle = (arch(at, terrain.from.x, terrain.to.x) * arch_y) >> kFraction;
            height = (smooth(middle) * (kOne + 3 * height) / 4) >> kFraction;
        }
        heights[k] = static_cast<int>((height * cells + kOne / 2) >> kFraction);
    }
}

}  // namespace voxilux
