#include "voxelizer/texture_pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/assert.h"
#include "base/colour.h"

namespace voxilux {
namespace {

// Bilinear taps across the shorter side of a piece, before the level is rounded to a finer one: 2 or 3 of
// them result. One tap blurs five times as much; more than three gain nothing (means_over_pieces in the
// tests).
constexpr float kTapsAcross = 1.5f;

// A piece longer than this many taps is blurred across instead, which bounds the cost of a lookup.
constexpr float kMaxTapsAlong = 16.0f;

// Texels that a piece may span: for larger pieces, or spans that are not finite, the mean of the texture
// serves.
constexpr float kLongestPiece = 1e6f;

// Largest sum of the squared edges, in texels, of a piece for which one tap suffices.
constexpr float kOneTapReach = 2.0f;

// A clamped coordinate farther out than this sees the same edge, and its texel index still fits an int.
constexpr float kFarBeside = 1e4f;

constexpr float kOne16 = 65535.0f;

const glm::u16vec4& stored(const TexturePyramid::Level& level, int x, int y) {
    return level.texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(level.size.x) +
                        static_cast<std::size_t>(x)];
}

glm::vec4 unit_of(const glm::u16vec4& texel) {
    return glm::vec4(texel) * (1.0f / kOne16);
}

glm::u16vec4 rounded(const glm::vec4& unit) {
    return glm::u16vec4(unit * kOne16 + 0.5f);
}

// The texels of a row that one texel of the row half as long covers, with weights: 2, or 3 for an odd length.
struct Cover {
    int first = 0;
    int count = 0;
    std::array<float, 4> weights{};
};

Cover texels_under(int i, int size, int larger) {
    const double ratio = static_cast<double>(larger) / size;
    const double low = i * ratio, high = (i + 1) * ratio;
    Cover cover{.first = static_cast<int>(low)};
    for (int at = cover.first; at < larger && at < high && cover.count < 4; ++at) {
        const double part = std::min(high, at + 1.0) - std::max(low, static_cast<double>(at));
        cover.weights[static_cast<std::size_t>(cover.count++)] = static_cast<float>(part / ratio);
    }
    return cover;
}

TexturePyramid::Level halve(const TexturePyramid::Level& from) {
    const glm::ivec2 larger = from.size;
    TexturePyramid::Level result{.size = glm::max(larger / 2, glm::ivec2(1)), .texels = {}};
    result.texels.reserve(static_cast<std::size_t>(result.size.x) * static_cast<std::size_t>(result.size.y));
    std::vector<Cover> columns;
    for (int x = 0; x < result.size.x; ++x)
        columns.push_back(texels_under(x, result.size.x, larger.x));
    for (int y = 0; y < result.size.y; ++y) {
        const Cover rows = texels_under(y, result.size.y, larger.y);
        for (const Cover& column : columns) {
            glm::vec4 mean(0.0f);
            for (int j = 0; j < rows.count; ++j) {
                for (int i = 0; i < column.count; ++i) {
                    const float weight = rows.weights[static_cast<std::size_t>(j)] *
                                         column.weights[static_cast<std::size_t>(i)];
                    mean += weight * unit_of(stored(from, column.first + i, rows.first + j));
                }
            }
            result.texels.push_back(rounded(glm::min(mean, 1.0f)));
        }
    }
    return result;
}

// Index in [0, size) of texel i of the infinite texture.
int wrapped(int i, int size, TextureWrap wrap) {
    if (i >= 0 && i < size) return i;
    if (wrap == TextureWrap::clamp_to_edge) return i < 0 ? 0 : size - 1;
    const int period = wrap == TextureWrap::repeat ? size : 2 * size;
    const int at = ((i % period) + period) % period;
    return at < size ? at : period - 1 - at;
}

// The floor of `value`, which must fit an int: std::floor is a call into the library.
int floor_of(float value) {
    const int whole = static_cast<int>(value);
    return static_cast<float>(whole) > value ? whole - 1 : whole;
}

// `u` shifted by whole periods into [0,2), where texel indices are small. Coordinates that are too large
// become 0.
float reduced(float u, TextureWrap wrap) {
    if (!(std::abs(u) < kLongestPiece)) return 0.0f;
    if (wrap == TextureWrap::clamp_to_edge) return std::clamp(u, -kFarBeside, kFarBeside);
    if (wrap == TextureWrap::repeat) return u - static_cast<float>(floor_of(u));
    return u - 2.0f * static_cast<float>(floor_of(0.5f * u));
}

template <class Wrapped>
glm::vec2 reduced(const Wrapped& wrap, const glm::vec2& uv) {
    return {reduced(uv.x, wrap.wrap_u), reduced(uv.y, wrap.wrap_v)};
}

// 65535 times the texture at texel coordinates of a level, where the centre of texel 0 is at 0.5.
template <class Wrapped>
glm::vec4 bilinear(const Wrapped& wrap, const TexturePyramid::Level& level, const glm::vec2& at) {
    const float x = at.x - 0.5f, y = at.y - 0.5f;
    const int low_x = floor_of(x), low_y = floor_of(y);
    const float part_x = x - static_cast<float>(low_x), part_y = y - static_cast<float>(low_y);
    const int x0 = wrapped(low_x, level.size.x, wrap.wrap_u);
    const int x1 = wrapped(low_x + 1, level.size.x, wrap.wrap_u);
    const int y0 = wrapped(low_y, level.size.y, wrap.wrap_v);
    const int y1 = wrapped(low_y + 1, level.size.y, wrap.wrap_v);
    const glm::u16vec4 &a = stored(level, x0, y0), &b = stored(level, x1, y0);
    const glm::u16vec4 &c = stored(level, x0, y1), &d = stored(level, x1, y1);
    const float of_d = part_x * part_y, of_c = part_y - of_d, of_b = part_x - of_d;
    const float of_a = 1.0f - part_x - of_c;
    glm::vec4 mean;
    for (int i = 0; i < 4; ++i)
        mean[i] = of_a * static_cast<float>(a[i]) + of_b * static_cast<float>(b[i]) +
                  of_c * static_cast<float>(c[i]) + of_d * static_cast<float>(d[i]);
    return mean;
}

// A rectangle, in texels, with the second moments of the parallelogram: along the axes of their ellipse.
struct Rectangle {
    glm::vec2 direction{1.0f, 0.0f};  // of the longer side
    float length = 0.0f;
    float width = 0.0f;
};

Rectangle rectangle_of(const glm::vec2& a, const glm::vec2& b) {
    const float xx = a.x * a.x + b.x * b.x, yy = a.y * a.y + b.y * b.y, xy = a.x * a.y + b.x * b.y;
    const float mean = 0.5f * (xx + yy), half = 0.5f * (xx - yy);
    const float root = std::sqrt(half * half + xy * xy);
    Rectangle rectangle{.length = std::sqrt(mean + root), .width = std::sqrt(std::max(mean - root, 0.0f))};
    const glm::vec2 axis = half > 0.0f ? glm::vec2(half + root, xy) : glm::vec2(xy, root - half);
    const float length = std::sqrt(axis.x * axis.x + axis.y * axis.y);
    if (length > 0.0f) rectangle.direction = axis / length;
    return rectangle;
}

// A piece wholly outside a clamped texture sees only its edge: nothing varies across it.
glm::mat2 clamped_span(const TexturePyramid& pyramid, const glm::vec2& center, glm::mat2 span) {
    const TextureWrap wraps[2] = {pyramid.wrap_u, pyramid.wrap_v};
    for (int axis = 0; axis < 2; ++axis) {
        const float reach = 0.5f * (std::abs(span[0][axis]) + std::abs(span[1][axis]));
        const bool is_beside = center[axis] + reach < 0.0f || center[axis] - reach > 1.0f;
        if (wraps[axis] == TextureWrap::clamp_to_edge && is_beside) span[0][axis] = span[1][axis] = 0.0f;
    }
    return span;
}

int tap_count(float texels) {
    return std::max(static_cast<int>(texels + 0.5f), 1);
}

// Level 0 from the stored texels.
TexturePyramid::Level linear_level(const Texture& texture, TexelMeaning meaning, float alpha_cutoff) {
    std::array<float, 256> linear{}, coverage{};
    for (std::size_t code = 0; code < 256; ++code) {
        const float value = static_cast<float>(code) / 255.0f;
        linear[code] =
            meaning == TexelMeaning::data ? value : linear_from_srgb(static_cast<std::uint8_t>(code));
        coverage[code] = meaning != TexelMeaning::masked_color ? value : value >= alpha_cutoff ? 1.0f : 0.0f;
    }
    const bool is_weighted = meaning == TexelMeaning::alpha_color || meaning == TexelMeaning::masked_color;
    TexturePyramid::Level level{.size = texture.size, .texels = {}};
    level.texels.reserve(texture.texels.size());
    for (const glm::u8vec4& code : texture.texels) {
        const float weight = is_weighted ? coverage[code.w] : 1.0f;
        level.texels.push_back(rounded(
            {linear[code.x] * weight, linear[code.y] * weight, linear[code.z] * weight, coverage[code.w]}));
    }
    return level;
}

}  // namespace

TexturePyramid build_pyramid(const Texture& texture, TexelMeaning meaning, float alpha_cutoff) {
    VX_ASSERT(texture.size.x > 0 && texture.size.y > 0);
    TexturePyramid pyramid{
        .levels = {}, .wrap_u = texture.wrap_u, .wrap_v = texture.wrap_v, .is_nearest = texture.is_nearest};
    pyramid.levels.push_back(linear_level(texture, meaning, alpha_cutoff));
    while (pyramid.levels.back().size != glm::ivec2(1))
        pyramid.levels.push_back(halve(pyramid.levels.back()));
    return pyramid;
}

// Taps about one texel of the chosen level apart fill the rectangle.
PieceFilter filter_of(const TexturePyramid& pyramid, const glm::mat2& span, FilterTaps taps) {
    PieceFilter filter{.level = &pyramid.levels[0], .wrap_u = pyramid.wrap_u, .wrap_v = pyramid.wrap_v};
    const glm::vec2 size(pyramid.levels[0].size);
    const glm::vec2 a = span[0] * size, b = span[1] * size;
    const float reach = glm::dot(a, a) + glm::dot(b, b);
    if (!(reach < kLongestPiece * kLongestPiece)) {
        filter.level = &pyramid.levels.back();
        return filter;
    }
    if (reach < kOneTapReach) {
        filter.is_nearest = pyramid.is_nearest;
        return filter;
    }
    const Rectangle piece = rectangle_of(a, b);
    const bool is_one = taps == FilterTaps::one;
    const float wanted =
        is_one ? piece.width : std::max(piece.width / kTapsAcross, piece.length / kMaxTapsAlong);
    std::size_t level = 0;
    float texel_size = 1.0f;  // in texels of level 0
    for (; 2.0f * texel_size <= wanted && level + 1 < pyramid.levels.size(); ++level)
        texel_size *= 2.0f;
    filter.level = &pyramid.levels[level];
    if (is_one) return filter;
    filter.along = tap_count(piece.length / texel_size);
    filter.across = tap_count(piece.width / texel_size);
    const glm::vec2 scale = glm::vec2(filter.level->size) / size;
    const glm::vec2 d = piece.direction;
    filter.step_along = scale * d * (piece.length / static_cast<float>(filter.along));
    filter.step_across = scale * glm::vec2(-d.y, d.x) * (piece.width / static_cast<float>(filter.across));
    return filter;
}

glm::vec4 filtered(const PieceFilter& filter, const glm::vec2& center) {
    const TexturePyramid::Level& level = *filter.level;
    const glm::vec2 at = reduced(filter, center) * glm::vec2(level.size);
    if (filter.is_nearest) {
        return unit_of(stored(level, wrapped(floor_of(at.x), level.size.x, filter.wrap_u),
                              wrapped(floor_of(at.y), level.size.y, filter.wrap_v)));
    }
    const int taps = filter.along * filter.across;
    if (taps == 1) return bilinear(filter, level, at) * (1.0f / kOne16);
    const glm::vec2 corner = at - 0.5f * static_cast<float>(filter.along - 1) * filter.step_along -
                             0.5f * static_cast<float>(filter.across - 1) * filter.step_across;
    glm::vec4 sum(0.0f);
    for (int j = 0; j < filter.across; ++j) {
        for (int i = 0; i < filter.along; ++i)
            sum += bilinear(filter, level,
                            corner + static_cast<float>(i) * filter.step_along +
                                static_cast<float>(j) * filter.step_across);
    }
    return sum * (1.0f / (kOne16 * static_cast<float>(taps)));
}

glm::vec4 sample_pyramid(const TexturePyramid& pyramid, const glm::vec2& center, const glm::mat2& span) {
    const glm::mat2 used = clamped_span(pyramid, center, span);
    return filtered(filter_of(pyramid, used, FilterTaps::as_many_as_needed), center);
}

}  // namespace voxilux
