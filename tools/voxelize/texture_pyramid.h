#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "voxelize/mesh.h"

namespace voxilux {

// What the stored texels mean.
enum class TexelMeaning : std::uint8_t {
    color,         // sRGB; alpha is left out of the mean
    alpha_color,   // sRGB; each texel counts by its alpha
    masked_color,  // sRGB; texels whose alpha is below the cutoff do not count
    data,          // linear
};

// A texture and its means over ever larger squares, in linear light. Level 0 is the texture itself, which
// must outlive the pyramid; a texel of level l is the mean of the part of level 0 that it covers. Where alpha
// counts, colours are stored multiplied by it. Source: Williams, Pyramidal parametrics, SIGGRAPH 1983.
struct TexturePyramid {
    struct Level {
        glm::ivec2 size{0};
        std::vector<glm::u16vec4> texels;  // linear, 65535 is 1; empty for level 0
    };
    const Texture* texture = nullptr;
    TexelMeaning meaning = TexelMeaning::color;
    float alpha_cutoff = 0.0f;          // of masked_color, for the alpha of the texture alone
    std::array<float, 256> linear{};    // of the stored red, green and blue
    std::array<float, 256> coverage{};  // of the stored alpha
    std::vector<Level> levels;
};

[[nodiscard]] TexturePyramid build_pyramid(const Texture& texture, TexelMeaning meaning,
                                           float alpha_cutoff = 0.0f);

// Linear mean of the texture over a parallelogram around `center` with the edges `span[0]` and `span[1]`, all
// in uv; xyz are multiplied by w where alpha counts. It weighs level, taps along the longer axis and bilinear
// interpolation such that the second moments of the weights are those of the parallelogram.
// Source: McCormack et al., Feline, SIGGRAPH 1999, for the taps on a line.
[[nodiscard]] glm::vec4 sample_pyramid(const TexturePyramid& pyramid, const glm::vec2& center,
                                       const glm::mat2& span);

}  // namespace voxilux
