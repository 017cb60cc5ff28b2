#include "voxelize/texture_pyramid.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "scene/colour.h"

namespace voxilux {
namespace {

// A line of more taps than this is blurred across instead: it bounds the cost of a lookup.
constexpr int kMostTaps = 16;

// The variance of one trilinear tap at level l, in texels of level 0, over 4^l: 1/12 of the box that a texel
// of the level is, and 1/6 of the tent that joins texels. A box of width w has the variance w^2 / 12.
constexpr float kTapVariance = 1.0f / 12.0f + 1.0f / 6.0f;

constexpr float kOne16 = 65535.0f;

glm::vec4 level0_texel(const TexturePyramid& pyramid, const glm::ivec2& at) {
    const Texture& texture = *pyramid.texture;
    const glm::u8vec4 code =
        texture.texels[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(texture.size.x) +
                       static_cast<std::size_t>(at.x)];
    const float weight = pyramid.coverage[code.w];
    const glm::vec3 rgb(pyramid.linear[code.x], pyramid.linear[code.y], pyramid.linear[code.z]);
    const bool is_weighted =
        pyramid.meaning == TexelMeaning::alpha_color || pyramid.meaning == TexelMeaning::masked_color;
    return {is_weighted ? rgb * weight : rgb, weight};
}

glm::vec4 texel(const TexturePyramid& pyramid, std::size_t level, const glm::ivec2& at) {
    if (level == 0) return level0_texel(pyramid, at);
    const TexturePyramid::Level& from = pyramid.levels[level];
    return glm::vec4(from.texels[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(from.size.x) +
                                 static_cast<std::size_t>(at.x)]) /
           kOne16;
}

// The parts of the texels of a row that one texel of the row half as long covers: 2, or 3 for an odd length.
struct Cover {
    int first = 0;
    int count = 0;
    std::array<float, 4> weights{};
};

Cover cover_of(int i, int size, int larger) {
    const double ratio = static_cast<double>(larger) / size;
    const double low = i * ratio, high = (i + 1) * ratio;
    Cover cover{.first = static_cast<int>(low)};
    for (int at = cover.first; at < larger && at < high && cover.count < 4; ++at) {
        const double part = std::min(high, at + 1.0) - std::max(low, static_cast<double>(at));
        cover.weights[static_cast<std::size_t>(cover.count++)] = static_cast<float>(part / ratio);
    }
    return cover;
}

TexturePyramid::Level halve(const TexturePyramid& pyramid, std::size_t level) {
    const glm::ivec2 larger = pyramid.levels[level].size;
    TexturePyramid::Level result{.size = glm::max(larger / 2, glm::ivec2(1)), .texels = {}};
    result.texels.reserve(static_cast<std::size_t>(result.size.x) * static_cast<std::size_t>(result.size.y));
    std::vector<Cover> columns;
    for (int x = 0; x < result.size.x; ++x)
        columns.push_back(cover_of(x, result.size.x, larger.x));
    for (int y = 0; y < result.size.y; ++y) {
        const Cover rows = cover_of(y, result.size.y, larger.y);
        for (const Cover& column : columns) {
            glm::vec4 mean(0.0f);
            for (int j = 0; j < rows.count; ++j) {
                for (int i = 0; i < column.count; ++i) {
                    const float weight = rows.weights[static_cast<std::size_t>(j)] *
                                         column.weights[static_cast<std::size_t>(i)];
                    mean += weight * texel(pyramid, level, {column.first + i, rows.first + j});
                }
            }
            result.texels.emplace_back(glm::clamp(mean * kOne16 + 0.5f, 0.0f, kOne16));
        }
    }
    return result;
}

// Index in [0, size) of any texel of the endless texture.
int wrapped(int i, int size, TextureWrap wrap) {
    if (i >= 0 && i < size) return i;
    if (wrap == TextureWrap::clamp_to_edge) return i < 0 ? 0 : size - 1;
    const int period = wrap == TextureWrap::repeat ? size : 2 * size;
    const int at = ((i % period) + period) % period;
    return at < size ? at : period - 1 - at;
}

// `u` moved by whole periods into [0,2), where texel numbers are small. Coordinates that are not finite
// become 0.
float reduced(float u, TextureWrap wrap) {
    if (!std::isfinite(u)) return 0.0f;
    if (wrap == TextureWrap::clamp_to_edge) return std::clamp(u, -1.0f, 2.0f);
    if (wrap == TextureWrap::repeat) return u - std::floor(u);
    return u - 2.0f * std::floor(0.5f * u);
}

glm::vec4 bilinear(const TexturePyramid& pyramid, std::size_t level, const glm::vec2& uv) {
    const glm::ivec2 size = pyramid.levels[level].size;
    const Texture& texture = *pyramid.texture;
    const glm::vec2 at = uv * glm::vec2(size) - 0.5f;
    const glm::vec2 low = glm::floor(at);
    const glm::vec2 part = at - low;
    const int x0 = wrapped(static_cast<int>(low.x), size.x, texture.wrap_u);
    const int x1 = wrapped(static_cast<int>(low.x) + 1, size.x, texture.wrap_u);
    const int y0 = wrapped(static_cast<int>(low.y), size.y, texture.wrap_v);
    const int y1 = wrapped(static_cast<int>(low.y) + 1, size.y, texture.wrap_v);
    const glm::vec4 top = glm::mix(texel(pyramid, level, {x0, y0}), texel(pyramid, level, {x1, y0}), part.x);
    const glm::vec4 bottom =
        glm::mix(texel(pyramid, level, {x0, y1}), texel(pyramid, level, {x1, y1}), part.x);
    return glm::mix(top, bottom, part.y);
}

glm::vec4 tap(const TexturePyramid& pyramid, float lod, const glm::vec2& uv) {
    const glm::vec2 at(reduced(uv.x, pyramid.texture->wrap_u), reduced(uv.y, pyramid.texture->wrap_v));
    const float highest = static_cast<float>(pyramid.levels.size() - 1);
    const float level = std::clamp(lod, 0.0f, highest);
    const auto low = static_cast<std::size_t>(level);
    const float part = level - static_cast<float>(low);
    const glm::vec4 fine = bilinear(pyramid, low, at);
    if (part == 0.0f) return fine;
    return glm::mix(fine, bilinear(pyramid, low + 1, at), part);
}

glm::vec4 nearest(const TexturePyramid& pyramid, const glm::vec2& uv) {
    const Texture& texture = *pyramid.texture;
    const glm::vec2 at(reduced(uv.x, texture.wrap_u), reduced(uv.y, texture.wrap_v));
    const glm::vec2 low = glm::floor(at * glm::vec2(texture.size));
    return level0_texel(pyramid, {wrapped(static_cast<int>(low.x), texture.size.x, texture.wrap_u),
                                  wrapped(static_cast<int>(low.y), texture.size.y, texture.wrap_v)});
}

// The parallelogram as a rectangle of equal second moments.
struct Rectangle {
    glm::vec2 long_edge{0.0f};  // in texels
    float length = 0.0f;
    float width = 0.0f;
};

Rectangle rectangle_of(const glm::vec2& a, const glm::vec2& b) {
    const float xx = a.x * a.x + b.x * b.x, yy = a.y * a.y + b.y * b.y, xy = a.x * a.y + b.x * b.y;
    const float mean = 0.5f * (xx + yy), half = 0.5f * (xx - yy);
    const float root = std::sqrt(half * half + xy * xy);
    Rectangle rectangle{.length = std::sqrt(mean + root), .width = std::sqrt(std::max(mean - root, 0.0f))};
    const float angle = 0.5f * std::atan2(xy, half);
    rectangle.long_edge = rectangle.length * glm::vec2(std::cos(angle), std::sin(angle));
    return rectangle;
}

// A part of the plane that lies wholly beside a clamped texture sees only its edge: nothing varies across.
glm::mat2 clamped_span(const Texture& texture, const glm::vec2& center, glm::mat2 span) {
    const TextureWrap wraps[2] = {texture.wrap_u, texture.wrap_v};
    for (int axis = 0; axis < 2; ++axis) {
        const float reach = 0.5f * (std::abs(span[0][axis]) + std::abs(span[1][axis]));
        const bool is_beside = center[axis] + reach < 0.0f || center[axis] - reach > 1.0f;
        if (wraps[axis] == TextureWrap::clamp_to_edge && is_beside) span[0][axis] = span[1][axis] = 0.0f;
    }
    return span;
}

}  // namespace

TexturePyramid build_pyramid(const Texture& texture, TexelMeaning meaning, float alpha_cutoff) {
    VX_ASSERT(texture.size.x > 0 && texture.size.y > 0);
    TexturePyramid pyramid{.texture = &texture, .meaning = meaning, .alpha_cutoff = alpha_cutoff};
    for (int code = 0; code < 256; ++code) {
        const auto at = static_cast<std::size_t>(code);
        const float value = static_cast<float>(code) / 255.0f;
        pyramid.linear[at] =
            meaning == TexelMeaning::data ? value : linear_from_srgb(static_cast<std::uint8_t>(code));
        pyramid.coverage[at] = meaning != TexelMeaning::masked_color ? value
                               : value >= alpha_cutoff               ? 1.0f
                                                                     : 0.0f;
    }
    pyramid.levels.push_back({.size = texture.size, .texels = {}});
    while (pyramid.levels.back().size != glm::ivec2(1))
        pyramid.levels.push_back(halve(pyramid, pyramid.levels.size() - 1));
    return pyramid;
}

glm::vec4 sample_pyramid(const TexturePyramid& pyramid, const glm::vec2& center, const glm::mat2& span) {
    const Texture& texture = *pyramid.texture;
    const glm::mat2 used = clamped_span(texture, center, span);
    const glm::vec2 size(texture.size);
    const Rectangle piece = rectangle_of(used[0] * size, used[1] * size);
    if (!std::isfinite(piece.length)) return tap(pyramid, static_cast<float>(pyramid.levels.size()), center);
    if (piece.length < 1.0f)
        return texture.is_nearest ? nearest(pyramid, center) : tap(pyramid, 0.0f, center);
    const float width = std::max({piece.width, piece.length / static_cast<float>(kMostTaps), 1.0f});
    const float lod = 0.5f * std::log2(std::max(width * width / 12.0f / kTapVariance, 1.0f));
    const int taps = std::clamp(static_cast<int>(std::lround(piece.length / width)), 1, kMostTaps);
    glm::vec4 sum(0.0f);
    const glm::vec2 step = piece.long_edge / size / static_cast<float>(taps);
    for (int i = 0; i < taps; ++i)
        sum += tap(pyramid, lod,
                   center + step * (static_cast<float>(i) + 0.5f - 0.5f * static_cast<float>(taps)));
    return sum / static_cast<float>(taps);
}

}  // namespace voxilux
