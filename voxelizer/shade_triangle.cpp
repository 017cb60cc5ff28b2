#include "voxelizer/shade_triangle.h"

#include <algorithm>
#include <cmath>

#include "voxelizer/surface_look.h"

namespace voxilux {
namespace {

// A visible fraction of a piece below this is only the blur of its neighbourhood in the texture.
constexpr float kMinShare = 1.0f / 16.0f;

// Pieces below kSmallArea, in voxels^2, are sampled as squares of side kSmallSide, others as one voxel.
constexpr float kSmallArea = 0.5f;
constexpr float kSmallSide = 0.5f;

bool is_textured(const MeshMaterial& material) {
    return material.base_color_texture || material.metallic_roughness_texture || material.emissive_texture;
}

}  // namespace

template <class T, int kSize>
T TriangleShade::Attribute<T, kSize>::at(glm::vec3 from_corner) const {
    T value = origin;
    for (int i = 0; i < kSize; ++i)
        value[i] += glm::dot(slope[static_cast<std::size_t>(i)], from_corner);
    return value;
}

template <class T, int kSize>
glm::mat2 TriangleShade::Attribute<T, kSize>::span(glm::vec3 along, glm::vec3 across) const {
    return {glm::dot(slope[0], along), glm::dot(slope[1], along), glm::dot(slope[0], across),
            glm::dot(slope[1], across)};
}

TriangleShade::TriangleShade(const Mesh& mesh, const MaterialSampler& sampler, const MeshTriangle& triangle,
                             const std::array<glm::vec3, 3>& corners)
    : sampler_(sampler), material_(mesh.materials[triangle.material]), corner_(corners[0]) {
    const glm::uvec3 v = triangle.vertices;
    const glm::vec3 edge_b = corners[1] - corners[0];
    const glm::vec3 edge_c = corners[2] - corners[0];
    const auto slopes = barycentric_slopes(edge_b, edge_c);
    const auto fit = [&](auto& attribute, const auto& values) {
        if (values.empty()) return;
        attribute.origin = values[v.x];
        for (std::size_t i = 0; i < attribute.slope.size(); ++i) {
            const auto k = static_cast<int>(i);
            attribute.slope[i] =
                slopes[0] * (values[v.y][k] - values[v.x][k]) + slopes[1] * (values[v.z][k] - values[v.x][k]);
        }
    };
    fit(uv0_, mesh.uv0);
    fit(uv1_, mesh.uv1);
    colour_.origin = glm::vec4(1.0f);
    fit(colour_, mesh.colors);
    is_plain_ = !is_textured(material_) && (mesh.colors.empty() || (mesh.colors[v.x] == mesh.colors[v.y] &&
                                                                    mesh.colors[v.x] == mesh.colors[v.z]));
    if (is_plain_) {
        plain_ = shaded(sampler.sample(triangle.material, {.vertex_color = colour_.origin}));
        return;
    }
    const float length = glm::length(edge_b);
    const glm::vec3 along = length > 0.0f ? edge_b / length : glm::vec3(0.0f);
    const glm::vec3 normal = glm::cross(edge_b, edge_c);
    const float twice_area = glm::length(normal);
    const glm::vec3 across = twice_area > 0.0f ? glm::cross(normal / twice_area, along) : glm::vec3(0.0f);
    SurfacePiece square{.span0 = uv0_.span(along, across), .span1 = uv1_.span(along, across)};
    large_ = sampler.prepare(triangle.material, square);
    square.span0 *= kSmallSide;
    square.span1 *= kSmallSide;
    small_ = sampler.prepare(triangle.material, square);
}

ShadedPiece TriangleShade::at(const CellPiece& piece) const {
    if (is_plain_) return plain_;
    const glm::vec3 from_corner = piece.centre - corner_;
    return shaded(sampler_.sample(
        piece.area < kSmallArea ? small_ : large_,
        {.uv0 = uv0_.at(from_corner), .uv1 = uv1_.at(from_corner), .vertex_color = colour_.at(from_corner)}));
}

ShadedPiece TriangleShade::shaded(const SurfaceColor& colour) const {
    const Look look = look_of(material_, colour);
    ShadedPiece result{.colour = colour_of(look, colour), .look = packed(look)};
    if (material_.alpha_mode == AlphaMode::mask)
        result.share = colour.alpha < kMinShare ? 0.0f : colour.alpha;
    return result;
}

}  // namespace voxilux
