#pragma once

#include <array>

#include <glm/glm.hpp>

#include "voxelizer/cell_piece.h"
#include "voxelizer/mesh.h"
#include "voxelizer/texture_sample.h"

namespace voxilux {

struct ShadedPiece {
    glm::vec3 colour{1.0f};  // linear
    std::uint16_t look = 0;  // see surface_look.h
    float share = 1.0f;  // fraction of the piece left by an alpha mask; 0 where that is too little to count
};

// The shading of a triangle, to be evaluated for its pieces. What it refers to must outlive it.
class TriangleShade {
  public:
    // `corners` in voxels.
    TriangleShade(const Mesh& mesh, const MaterialSampler& sampler, const MeshTriangle& triangle,
                  const std::array<glm::vec3, 3>& corners);

    // Whether the result is the same for every piece.
    [[nodiscard]] bool is_plain() const { return is_plain_; }

    [[nodiscard]] ShadedPiece at(const CellPiece& piece) const;

  private:
    [[nodiscard]] ShadedPiece shaded(const SurfaceColor& colour) const;

    // An attribute as a linear function of the position.
    template <class T, int kSize>
    struct Attribute {
        T origin{};                            // at corner 0
        std::array<glm::vec3, kSize> slope{};  // per voxel
        [[nodiscard]] T at(glm::vec3 from_corner) const;
        [[nodiscard]] glm::mat2 span(glm::vec3 along, glm::vec3 across) const;
    };

    const MaterialSampler& sampler_;
    const MeshMaterial& material_;
    glm::vec3 corner_;
    Attribute<glm::vec2, 2> uv0_, uv1_;
    Attribute<glm::vec4, 4> colour_;
    // for pieces like a square of one voxel on the triangle, and of half a voxel
    MaterialSampler::Prepared large_, small_;
    bool is_plain_ = true;
    ShadedPiece plain_;
};

}  // namespace voxilux
