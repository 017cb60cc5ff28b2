#pragma once

// A palette for weighted colours in groups: each group is split at the mean along its principal axis, always
// the part with the largest squared error (X. Wu, "Color Quantization by Dynamic Programming and Principal
// Analysis", 1992, greedy), in Oklab; then Lloyd's iterations (k-means) within each group. Deterministic.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace voxilux {

struct WeightedColour {
    glm::vec3 oklab{0.0f};
    float weight = 0.0f;
    std::uint32_t group = 0;  // colours of different groups never share an entry
};

struct QuantizedColours {
    struct Entry {
        glm::vec3 oklab{0.0f};
        std::uint32_t group = 0;
    };
    std::vector<Entry> entries;           // by group
    std::vector<std::uint16_t> entry_of;  // of each colour
};

// At most `most` entries, at least one for each group; `most` must be at least the number of groups.
[[nodiscard]] QuantizedColours quantize_colours(std::span<const WeightedColour> colours, std::size_t most);

}  // namespace voxilux
