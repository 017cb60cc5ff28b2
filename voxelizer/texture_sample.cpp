#include "voxelizer/texture_sample.h"

#include <cmath>

namespace voxilux {
namespace {

TexelMeaning base_color_meaning(AlphaMode mode) {
    switch (mode) {
        case AlphaMode::opaque:
            return TexelMeaning::color;
        case AlphaMode::mask:
            return TexelMeaning::masked_color;
        case AlphaMode::blend:
            return TexelMeaning::alpha_color;
    }
    return TexelMeaning::color;
}

// The alpha that a texel needs to pass; above 1 none does.
float texel_cutoff(const MeshMaterial& material) {
    if (material.alpha_mode != AlphaMode::mask || material.alpha_cutoff <= 0.0f) return 0.0f;
    return material.base_color.a > 0.0f ? material.alpha_cutoff / material.base_color.a : 2.0f;
}

float alpha_of(const MeshMaterial& material, float texel_alpha, float vertex_alpha, bool has_texture) {
    const float alpha = material.base_color.a * vertex_alpha;
    switch (material.alpha_mode) {
        case AlphaMode::opaque:
            return 1.0f;
        case AlphaMode::mask:
            return has_texture ? texel_alpha : alpha >= material.alpha_cutoff ? 1.0f : 0.0f;
        case AlphaMode::blend:
            return texel_alpha * alpha;
    }
    return 1.0f;
}

}  // namespace

MaterialSampler::MaterialSampler(const Mesh& mesh) : materials_(mesh.materials) {
    Known known;
    for (const MeshMaterial& material : materials_) {
        const auto use = [&](const std::optional<TextureUse>& texture, TexelMeaning meaning) {
            const bool is_masked = meaning == TexelMeaning::masked_color;
            return add_use(mesh, texture, {meaning, is_masked ? texel_cutoff(material) : 0.0f}, known);
        };
        uses_.push_back(
            {.base_color = use(material.base_color_texture, base_color_meaning(material.alpha_mode)),
             .metallic_roughness = use(material.metallic_roughness_texture, TexelMeaning::data),
             .emissive = use(material.emissive_texture, TexelMeaning::color)});
    }
}

std::optional<MaterialSampler::Use> MaterialSampler::add_use(const Mesh& mesh,
                                                             const std::optional<TextureUse>& use,
                                                             const Reading& reading, Known& known) {
    if (!use) return std::nullopt;
    const auto [found, is_new] = known.try_emplace({use->texture, reading.meaning, reading.alpha_cutoff},
                                                   static_cast<std::uint32_t>(pyramids_.size()));
    if (is_new)
        pyramids_.push_back(
            build_pyramid(mesh.textures.at(use->texture), reading.meaning, reading.alpha_cutoff));
    return Use{.pyramid = found->second,
               .uv_set = use->uv_set,
               .linear = glm::mat2(glm::dmat2(use->transform)),
               .offset = glm::vec2(use->transform[2])};
}

glm::vec4 MaterialSampler::mean_of(const Use& use, const SurfacePiece& piece) const {
    const glm::vec2 uv = use.linear * (use.uv_set == 0 ? piece.uv0 : piece.uv1) + use.offset;
    return sample_pyramid(pyramids_[use.pyramid], uv,
                          use.linear * (use.uv_set == 0 ? piece.span0 : piece.span1));
}

// mean_of_use(which, prepared) is the mean of one use, named as a member of Uses and of Prepared.
template <class MeanOf>
SurfaceColor MaterialSampler::colour_of(std::uint32_t index, const SurfacePiece& piece,
                                        const MeanOf& mean_of_use) const {
    const MeshMaterial& material = materials_[index];
    const Uses& uses = uses_[index];
    SurfaceColor result{.base_color = glm::vec3(material.base_color) * glm::vec3(piece.vertex_color),
                        .metallic = material.metallic,
                        .roughness = material.roughness,
                        .emissive = material.emissive};
    float texel_alpha = 1.0f;
    if (uses.base_color) {
        const glm::vec4 mean = mean_of_use(&Uses::base_color, &Prepared::base_color);
        texel_alpha = mean.a;
        if (material.alpha_mode == AlphaMode::opaque)
            result.base_color *= glm::vec3(mean);
        else if (mean.a > 0.0f)
            result.base_color *= glm::vec3(mean) / mean.a;
    }
    result.alpha = alpha_of(material, texel_alpha, piece.vertex_color.a, uses.base_color.has_value());
    if (uses.metallic_roughness) {
        const glm::vec4 mean = mean_of_use(&Uses::metallic_roughness, &Prepared::metallic_roughness);
        result.metallic *= mean.b;
        result.roughness *= mean.g;
    }
    if (uses.emissive) result.emissive *= glm::vec3(mean_of_use(&Uses::emissive, &Prepared::emissive));
    return result;
}

SurfaceColor MaterialSampler::sample(std::uint32_t material, const SurfacePiece& piece) const {
    return colour_of(material, piece,
                     [&](auto which, auto) { return mean_of(*(uses_[material].*which), piece); });
}

MaterialSampler::Prepared MaterialSampler::prepare(std::uint32_t material, const SurfacePiece& piece) const {
    const Uses& uses = uses_[material];
    const auto filter = [&](const std::optional<Use>& use, FilterTaps taps) -> std::optional<PieceFilter> {
        if (!use) return std::nullopt;
        return filter_of(pyramids_[use->pyramid],
                         use->linear * (use->uv_set == 0 ? piece.span0 : piece.span1), taps);
    };
    return {.material = material,
            .base_color = filter(uses.base_color, FilterTaps::as_many_as_needed),
            .metallic_roughness = filter(uses.metallic_roughness, FilterTaps::one),
            .emissive = filter(uses.emissive, FilterTaps::one)};
}

SurfaceColor MaterialSampler::sample(const Prepared& prepared, const SurfacePiece& piece) const {
    return colour_of(prepared.material, piece, [&](auto which, auto filter) {
        const Use& use = *(uses_[prepared.material].*which);
        return filtered(*(prepared.*filter),
                        use.linear * (use.uv_set == 0 ? piece.uv0 : piece.uv1) + use.offset);
    });
}

}  // namespace voxilux
