// Means of textures over pieces of a surface, against closed forms and against many samples in double.

#include "voxelizer/texture_sample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace voxilux {
namespace {

double linear_of(std::uint8_t code) {
    const double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

Texture noise(const glm::ivec2& size, unsigned seed) {
    std::mt19937 random(seed);
    Texture texture{.name = "noise", .size = size, .texels = {}};
    for (int i = 0; i < size.x * size.y; ++i) {
        const auto code = [&] { return static_cast<std::uint8_t>(random() % 256); };
        const auto a = code(), b = code(), g = code(), r = code();  // in an order that is the same everywhere
        texture.texels.emplace_back(r, g, b, a);
    }
    return texture;
}

// Blotches about 8 texels wide, more like a picture than noise is.
Texture blotches(int size, unsigned seed) {
    const Texture small = noise({size / 8, size / 8}, seed);
    Texture texture{.name = "blotches", .size = {size, size}, .texels = {}};
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x)
            texture.texels.push_back(small.texels[static_cast<std::size_t>(y / 8 * (size / 8) + x / 8)]);
    }
    return texture;
}

int wrapped(int i, int size, TextureWrap wrap) {
    if (wrap == TextureWrap::clamp_to_edge) return std::min(std::max(i, 0), size - 1);
    const int turn = static_cast<int>(std::floor(static_cast<double>(i) / size));
    const int at = i - turn * size;
    return wrap == TextureWrap::mirrored_repeat && turn % 2 != 0 ? size - 1 - at : at;
}

// Red of the texture at one point: bilinear, in linear light.
double point_red(const Texture& texture, const glm::dvec2& uv) {
    const glm::dvec2 at = uv * glm::dvec2(texture.size) - 0.5;
    const glm::dvec2 low = glm::floor(at);
    double sum = 0.0;
    for (int dy = 0; dy < 2; ++dy) {
        for (int dx = 0; dx < 2; ++dx) {
            const int x = wrapped(static_cast<int>(low.x) + dx, texture.size.x, texture.wrap_u);
            const int y = wrapped(static_cast<int>(low.y) + dy, texture.size.y, texture.wrap_v);
            const double weight = std::abs(1 - dx - (at.x - low.x)) * std::abs(1 - dy - (at.y - low.y));
            sum += weight * linear_of(texture.texels[static_cast<std::size_t>(y * texture.size.x + x)].r);
        }
    }
    return sum;
}

double mean_red(const Texture& texture, const glm::dvec2& center, const glm::dmat2& span) {
    constexpr int kSteps = 32;
    double sum = 0.0;
    for (int j = 0; j < kSteps; ++j) {
        for (int i = 0; i < kSteps; ++i) {
            const glm::dvec2 at((i + 0.5) / kSteps - 0.5, (j + 0.5) / kSteps - 0.5);
            sum += point_red(texture, center + span * at);
        }
    }
    return sum / (kSteps * kSteps);
}

struct Piece {
    glm::vec2 center;
    glm::mat2 span;
};

// Pieces of `texels` texels on their longer side, turned and sheared, some of them across borders.
std::vector<Piece> random_pieces(double texels, const Texture& texture, int count) {
    std::mt19937 random(17);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<Piece> pieces;
    for (int i = 0; i < count; ++i) {
        const double angle = 6.2832 * unit(random), shear = angle + 0.6 + 1.9 * unit(random);
        const double length = texels / texture.size.x, width = length * (0.2 + 0.8 * unit(random));
        const glm::dmat2 span(length * glm::dvec2(std::cos(angle), std::sin(angle)),
                              width * glm::dvec2(std::cos(shear), std::sin(shear)));
        const double y = 4.0 * unit(random) - 2.0, x = 4.0 * unit(random) - 2.0;
        pieces.push_back({glm::vec2(x, y), glm::mat2(span)});
    }
    return pieces;
}

// Root mean square difference of the sampled red from the truth, which may use another texture.
double rms_error(const Texture& sampled, const Texture& truth, double texels) {
    const TexturePyramid pyramid = build_pyramid(sampled, TexelMeaning::color);
    constexpr int kPieces = 80;
    double sum = 0.0;
    for (const Piece& piece : random_pieces(texels, sampled, kPieces)) {
        const double red = sample_pyramid(pyramid, piece.center, piece.span).r;
        const double difference = red - mean_red(truth, glm::dvec2(piece.center), glm::dmat2(piece.span));
        sum += difference * difference;
    }
    return std::sqrt(sum / kPieces);
}

constexpr TextureWrap kWraps[] = {TextureWrap::repeat, TextureWrap::mirrored_repeat,
                                  TextureWrap::clamp_to_edge};

TEST(TexturePyramid, points_equal_bilinear_texels_in_every_wrap_mode) {
    for (const TextureWrap wrap : kWraps) {
        Texture texture = noise({7, 5}, 3);
        texture.wrap_u = wrap;
        texture.wrap_v = wrap;
        const TexturePyramid pyramid = build_pyramid(texture, TexelMeaning::color);
        for (const Piece& piece : random_pieces(0.0, texture, 200)) {
            EXPECT_NEAR(sample_pyramid(pyramid, piece.center, glm::mat2(0.0f)).r,
                        point_red(texture, glm::dvec2(piece.center)), 2e-5);
        }
    }
}

TEST(TexturePyramid, wrong_wrap_mode_is_seen) {
    Texture texture = noise({7, 5}, 3);
    Texture other = texture;
    other.wrap_u = TextureWrap::mirrored_repeat;
    EXPECT_LT(rms_error(texture, texture, 0.5), 0.02);
    EXPECT_GT(rms_error(texture, other, 0.5), 0.1);
}

TEST(TexturePyramid, piece_as_large_as_the_texture_gives_its_mean) {
    for (const glm::ivec2 size : {glm::ivec2(64, 64), glm::ivec2(37, 21), glm::ivec2(1, 9)}) {
        const Texture texture = noise(size, 5);
        double mean = 0.0;
        for (const glm::u8vec4& texel : texture.texels)
            mean += linear_of(texel.r) / static_cast<double>(texture.texels.size());
        const TexturePyramid pyramid = build_pyramid(texture, TexelMeaning::color);
        const glm::mat2 span = 64.0f * glm::mat2(1.0f);
        EXPECT_NEAR(sample_pyramid(pyramid, {0.3f, 0.8f}, span).r, mean, 1e-4);
    }
}

TEST(TexturePyramid, means_over_pieces_are_near_those_of_many_samples) {
    for (const TextureWrap wrap : kWraps) {
        Texture texture = blotches(128, 9);
        texture.wrap_u = texture.wrap_v = wrap;
        for (const double texels : {0.7, 2.0, 5.0, 12.0, 30.0, 70.0}) {
            const double error = rms_error(texture, texture, texels);
            EXPECT_LT(error, 0.028) << texels << " texels, wrap " << static_cast<int>(wrap);
        }
    }
}

TEST(TexturePyramid, another_texture_is_far_from_many_samples) {
    EXPECT_GT(rms_error(blotches(128, 9), blotches(128, 10), 5.0), 0.2);
    EXPECT_GT(rms_error(blotches(128, 9), blotches(128, 10), 30.0), 0.07);
}

TEST(TexturePyramid, texel_below_the_cutoff_does_not_colour) {
    Texture texture{.name = "leaf", .size = {2, 1}, .texels = {{255, 0, 0, 255}, {0, 255, 0, 10}}};
    const TexturePyramid pyramid = build_pyramid(texture, TexelMeaning::masked_color, 0.5f);
    const glm::vec4 mean = sample_pyramid(pyramid, {0.5f, 0.5f}, 8.0f * glm::mat2(1.0f));
    EXPECT_NEAR(mean.r, 0.5f, 1e-4f);
    EXPECT_EQ(mean.g, 0.0f);
    EXPECT_NEAR(mean.a, 0.5f, 1e-4f);
}

TEST(TexturePyramid, numbers_that_are_not_finite_give_a_colour) {
    const Texture texture = noise({8, 8}, 1);
    const TexturePyramid pyramid = build_pyramid(texture, TexelMeaning::color);
    const float bad[] = {NAN, INFINITY, -INFINITY, 3e38f};
    for (const float value : bad) {
        const glm::vec4 a = sample_pyramid(pyramid, glm::vec2(value), glm::mat2(0.1f));
        const glm::vec4 b = sample_pyramid(pyramid, glm::vec2(0.5f), glm::mat2(value));
        EXPECT_TRUE(std::isfinite(a.r) && std::isfinite(b.r)) << value;
    }
}

Mesh mesh_with(MeshMaterial material, Texture texture) {
    Mesh mesh;
    mesh.materials.push_back(std::move(material));
    mesh.textures.push_back(std::move(texture));
    return mesh;
}

Texture flat(const glm::u8vec4& code) {
    return {.name = "flat", .size = {1, 1}, .texels = {code}};
}

TEST(MaterialSampler, factor_texture_and_vertex_colour_are_multiplied) {
    const Mesh mesh = mesh_with({.base_color = {0.5f, 1, 1, 1}, .base_color_texture = TextureUse{}},
                                flat({188, 255, 0, 9}));
    const SurfaceColor color = MaterialSampler(mesh).sample(0, {.vertex_color = {0.5f, 0.25f, 1, 1}});
    EXPECT_NEAR(color.base_color.r, 0.25 * linear_of(188), 1e-5);
    EXPECT_NEAR(color.base_color.g, 0.25f, 1e-5f);
    EXPECT_EQ(color.base_color.b, 0.0f);
    EXPECT_EQ(color.alpha, 1.0f) << "the alpha of opaque materials does not count";
}

TEST(MaterialSampler, blended_texture_weighs_its_colours_by_alpha) {
    Texture texture{.name = "glass", .size = {2, 1}, .texels = {{255, 0, 0, 255}, {0, 255, 0, 0}}};
    Mesh mesh = mesh_with(
        {.base_color = {1, 1, 1, 0.5f}, .base_color_texture = TextureUse{}, .alpha_mode = AlphaMode::blend},
        texture);
    const SurfacePiece piece{.uv0 = {0.5f, 0.5f}, .span0 = 8.0f * glm::mat2(1.0f)};
    const SurfaceColor color = MaterialSampler(mesh).sample(0, piece);
    EXPECT_NEAR(color.base_color.r, 1.0f, 1e-4f);
    EXPECT_EQ(color.base_color.g, 0.0f);
    EXPECT_NEAR(color.alpha, 0.25f, 1e-4f);
}

TEST(MaterialSampler, mask_gives_the_part_that_is_there) {
    Texture texture{.name = "leaf",
                    .size = {4, 1},
                    .texels = {{9, 9, 9, 255}, {9, 9, 9, 140}, {9, 9, 9, 120}, {9, 9, 9, 200}}};
    const MeshMaterial material{
        .base_color = {1, 1, 1, 0.8f}, .base_color_texture = TextureUse{}, .alpha_mode = AlphaMode::mask};
    const SurfacePiece piece{.uv0 = {0.5f, 0.5f}, .span0 = 16.0f * glm::mat2(1.0f)};
    // 0.5 / 0.8 of 255 is 159.4: two of four pass.
    EXPECT_NEAR(MaterialSampler(mesh_with(material, texture)).sample(0, piece).alpha, 0.5f, 1e-4f);
    const Mesh bare = mesh_with({.base_color = {1, 1, 1, 0.4f}, .alpha_mode = AlphaMode::mask}, texture);
    EXPECT_EQ(MaterialSampler(bare).sample(0, piece).alpha, 0.0f);
    EXPECT_EQ(MaterialSampler(bare).sample(0, {.vertex_color = {1, 1, 1, 1}}).alpha, 0.0f);
}

TEST(MaterialSampler, texture_transform_and_second_coordinates_are_followed) {
    Texture texture{
        .name = "halves", .size = {2, 1}, .texels = {{255, 0, 0, 255}, {0, 0, 255, 255}}, .is_nearest = true};
    TextureUse use{.uv_set = 1};
    use.transform[2] = glm::dvec3(0.5, 0.0, 1.0);
    const Mesh mesh = mesh_with({.base_color_texture = use}, texture);
    const SurfaceColor color = MaterialSampler(mesh).sample(0, {.uv0 = {0.75f, 0.5f}, .uv1 = {0.25f, 0.5f}});
    EXPECT_EQ(color.base_color, glm::vec3(0, 0, 1));
    const SurfaceColor other = MaterialSampler(mesh).sample(0, {.uv0 = {0.25f, 0.5f}, .uv1 = {0.75f, 0.5f}});
    EXPECT_EQ(other.base_color, glm::vec3(1, 0, 0));
}

TEST(MaterialSampler, metal_roughness_and_emission_are_read_as_stored) {
    Mesh mesh = mesh_with({.metallic = 0.5f,
                           .roughness = 0.8f,
                           .metallic_roughness_texture = TextureUse{},
                           .emissive = {2, 2, 2},
                           .emissive_texture = TextureUse{.texture = 1}},
                          flat({0, 51, 102, 255}));
    mesh.textures.push_back(flat({188, 0, 255, 255}));
    const SurfaceColor color = MaterialSampler(mesh).sample(0, {});
    EXPECT_NEAR(color.metallic, 0.5 * 0.4, 1e-5);
    EXPECT_NEAR(color.roughness, 0.8 * 0.2, 1e-5);
    EXPECT_NEAR(color.emissive.r, 2 * linear_of(188), 2e-5);
    EXPECT_EQ(color.emissive.g, 0.0f);
    EXPECT_NEAR(color.emissive.b, 2.0f, 1e-5f);
}

}  // namespace
}  // namespace voxilux
