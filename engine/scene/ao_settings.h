#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace voxilux {

// How ambient occlusion is found: `brute` traces rays for each pixel alone, `hash` shares them in cells of
// the surface that outlive a frame. Automatic leaves it to the plan.
enum class AoMethod : std::uint8_t { automatic, brute, hash };
inline constexpr std::array<std::string_view, 3> kAoMethodNames{"auto", "brute", "hash"};  // in that order
inline constexpr std::array<std::string_view, 2> kAoSamplingNames{"cell", "pixel"};        // of `by_pixel`

// Settings of the hash; shaders/shared/ao_cell.h says what a cell is.
struct AoSettings {
    AoMethod method = AoMethod::automatic;
    float cell_px = 10.0f;  // largest width of a cell, pixels; cells have at least half of it
    // Look for a cell where the previous sample saw it before searching the table; absent: the plan chooses.
    std::optional<bool> reproject;
    std::optional<bool> merged;      // search and trace in one pass; absent: the plan chooses
    bool checkerboard = false;       // every other pixel takes samples
    bool by_pixel = false;           // rays start at the pixel's hit and follow the pixel's own sequence
    std::uint32_t filter = 0;        // iterations of the a-trous filter
    std::uint32_t sample_limit = 0;  // cells with as many samples take no more; 0: no limit
    std::uint32_t slots = 0;         // of the table, a power of two; 0: the plan chooses

    bool operator==(const AoSettings&) const = default;
};

}  // namespace voxilux
