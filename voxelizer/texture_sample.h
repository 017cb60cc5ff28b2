#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include <glm/glm.hpp>

#include "voxelizer/mesh.h"
#include "voxelizer/texture_pyramid.h"

namespace voxilux {

// A piece of a triangle: its centroid, and for each set of texture coordinates a parallelogram with the
// second moments of the piece: columns are its edges in uv. A zero span samples a point.
struct SurfacePiece {
    glm::vec2 uv0{0.0f};
    glm::vec2 uv1{0.0f};
    glm::mat2 span0{0.0f};
    glm::mat2 span1{0.0f};
    glm::vec4 vertex_color{1.0f};  // mean over the piece, linear
};

// Linear means over a piece.
struct SurfaceColor {
    glm::vec3 base_color{1.0f};
    float alpha = 1.0f;  // opaque: 1; mask: the visible fraction of the piece; blend: mean alpha
    float metallic = 0.0f;
    float roughness = 1.0f;
    glm::vec3 emissive{0.0f};
};

// Evaluates the materials of a mesh over pieces of its surface. Safe to use from many threads. The mesh must
// outlive it and keep its textures.
class MaterialSampler {
  public:
    explicit MaterialSampler(const Mesh& mesh);

    // Where alpha counts (mask, blend), the base colour is weighted by it; if nothing of the piece is
    // visible, it is that of the factor.
    [[nodiscard]] SurfaceColor sample(std::uint32_t material, const SurfacePiece& piece) const;

    // Everything that sample() can precompute for pieces of one material and shape, given by the spans of
    // `piece`.
    struct Prepared {
        std::uint32_t material = 0;
        std::optional<PieceFilter> base_color, metallic_roughness, emissive;
    };
    // Metalness, roughness and emission use single taps.
    [[nodiscard]] Prepared prepare(std::uint32_t material, const SurfacePiece& piece) const;
    // Uses the positions and the vertex colour of `piece`.
    [[nodiscard]] SurfaceColor sample(const Prepared& prepared, const SurfacePiece& piece) const;

  private:
    struct Use {
        std::uint32_t pyramid = 0;
        std::uint32_t uv_set = 0;
        glm::mat2 linear{1.0f};
        glm::vec2 offset{0.0f};
    };
    struct Uses {
        std::optional<Use> base_color, metallic_roughness, emissive;
    };

    struct Reading {
        TexelMeaning meaning = TexelMeaning::color;
        float alpha_cutoff = 0.0f;
    };
    using Known = std::map<std::tuple<std::uint32_t, TexelMeaning, float>, std::uint32_t>;

    std::optional<Use> add_use(const Mesh& mesh, const std::optional<TextureUse>& use, const Reading& reading,
                               Known& known);
    [[nodiscard]] glm::vec4 mean_of(const Use& use, const SurfacePiece& piece) const;
    template <class MeanOf>
    [[nodiscard]] SurfaceColor colour_of(std::uint32_t material, const SurfacePiece& piece,
                                         const MeanOf& mean_of_use) const;

    std::vector<MeshMaterial> materials_;
    std::vector<TexturePyramid> pyramids_;
    std::vector<Uses> uses_;  // by material
};

}  // namespace voxilux
