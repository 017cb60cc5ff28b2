#include "scene/terrain.h"

#include <algorithm>

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

std::int64_t octave_height(std::int64_t x, std::int64_t y, std::uint32_t octave,
                           const TerrainShape& terrain) {
    const std::int64_t cell = std::max(1, terrain.feature >> octave);
    const std::int64_t i = floor_div(x, cell), j = floor_div(y, cell);
    const std::int64_t tx = smooth((x - i * cell) * kOne / cell), ty = smooth((y - j * cell) * kOne / cell);
    const auto height = [&](std::int64_t di, std::int64_t dj) {
        return lattice_height(i + di, j + dj, octave, terrain.seed);
    };
    return blend(blend(height(0, 0), height(1, 0), tx), blend(height(0, 1), height(1, 1), tx), ty);
}

// 1 in the middle of the range, 0 at its ends: 1 - u^2.
std::int64_t arch(std::int64_t at, std::int64_t from, std::int64_t to) {
    const std::int64_t u = (2 * (at - from) + 1) * kOne / (to - from) - kOne;
    return kOne - ((u * u) >> kFraction);
}

}  // namespace

int terrain_height(const TerrainShape& terrain, int x, int y) {
    std::int64_t sum = 0;
    for (std::uint32_t octave = 0; octave < kOctaves; ++octave)
        sum += octave_height(x, y, octave, terrain) << (kOctaves - 1 - octave);
    // The weights are 8, 4, 2, 1. Sums of noise crowd around the middle: the stretch makes plains and peaks.
    const std::int64_t mean = sum / ((1 << kOctaves) - 1);
    std::int64_t height = std::clamp<std::int64_t>((16 * mean - 4 * kOne) / 8, 0, kOne);
    if (terrain.island) {
        const std::int64_t middle =
            (arch(x, terrain.from.x, terrain.to.x) * arch(y, terrain.from.y, terrain.to.y)) >> kFraction;
        height = (smooth(middle) * (kOne + 3 * height) / 4) >> kFraction;
    }
    const std::int64_t cells = std::int64_t{terrain.to.z} - terrain.from.z;
    return static_cast<int>((height * cells + kOne / 2) >> kFraction);
}

}  // namespace voxilux
