#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "voxelizer/mesh.h"

namespace voxilux {

// What the stored texels mean.
enum class TexelMeaning : std::uint8_t {
    color,         // sRGB; alpha is left out of the mean
    alpha_color,   // sRGB; each texel is weighted by its alpha
    masked_color,  // sRGB; texels whose alpha is below the cutoff do not count
    data,          // linear
};

// A texture in linear light, and its means over ever larger squares: level 0 has the texels of the texture,
// and a texel of level l is the mean of the part of level 0 that it covers. Where alpha counts, colours are
// premultiplied by it. Source: Williams, Pyramidal parametrics, SIGGRAPH 1983.
struct TexturePyramid {
    struct Level {
        glm::ivec2 size{0};
        std::vector<glm::u16vec4> texels;  // 65535 is 1
    };
    std::vector<Level> levels;
    TextureWrap wrap_u = TextureWrap::repeat;
    TextureWrap wrap_v = TextureWrap::repeat;
    bool is_nearest = false;
};

// `alpha_cutoff` is for masked_color, applied to the alpha of the texture alone.
[[nodiscard]] TexturePyramid build_pyramid(const Texture& texture, TexelMeaning meaning,
                                           float alpha_cutoff = 0.0f);

// Linear mean of the texture over a parallelogram around `center` with the edges `span[0]` and `span[1]`, all
// in uv; xyz are premultiplied by w where alpha counts. Level, taps along the longer axis and bilinear
// interpolation are chosen so that the second moments of the weights are those of the parallelogram. Source:
// McCormack et al., Feline, SIGGRAPH 1999, for the taps on a line.
[[nodiscard]] glm::vec4 sample_pyramid(const TexturePyramid& pyramid, const glm::vec2& center,
                                       const glm::mat2& span);

// How sample_pyramid samples pieces of one shape: made once for all pieces of a triangle.
struct PieceFilter {
    const TexturePyramid::Level* level = nullptr;
    glm::vec2 step_along{0.0f};  // between taps, in texels of the level
    glm::vec2 step_across{0.0f};
    int along = 1;  // taps
    int across = 1;
    TextureWrap wrap_u = TextureWrap::repeat;
    TextureWrap wrap_v = TextureWrap::repeat;
    bool is_nearest = false;
};

// With one tap the mean is blurred more but takes one lookup. The pyramid must outlive the filter. Pieces
// outside a clamped texture are blurred along its edge, unlike in sample_pyramid.
enum class FilterTaps : std::uint8_t { as_many_as_needed, one };
[[nodiscard]] PieceFilter filter_of(const TexturePyramid& pyramid, const glm::mat2& span, FilterTaps taps);

// The mean around `center`, in uv, as sample_pyramid returns it.
[[nodiscard]] glm::vec4 filtered(const PieceFilter& filter, const glm::vec2& center);

}  // namespace voxilux
