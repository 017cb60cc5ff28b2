#pragma once

// The part of a plane in a cell that no edge crosses, found without cutting: area and centroid depend only on
// the normal and the distance from the cell's centre, so they are tabulated once, for normals with increasing
// absolute components.

#include <array>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "voxelizer/cell_piece.h"

namespace voxilux {

// Sections of the unit cube around the origin, indexed by the two smaller components of the normal relative
// to the largest, and by the distance relative to that of the farthest corner. Off by at most 0.05 voxel (see
// the tests).
class SectionTable {
  public:
    SectionTable();

    struct Section {
        glm::vec3 centre{0.0f};  // components in the order small, middle, large
        float area = 0.0f;
    };
    static constexpr int kSlopes = 16;
    static constexpr int kDistances = 32;

    // kDistances sections of the normal nearest to (small, middle, 1).
    [[nodiscard]] const Section* sections_of(float small, float middle) const;

  private:
    std::vector<Section> sections_;
};

// One plane, prepared for lookups.
class PlaneSections {
  public:
    PlaneSections(const SectionTable& table, const std::array<glm::vec3, 3>& triangle);

    // The piece in the cell whose low corner is `cell`, as if the plane had no edge there. Nothing when its
    // centroid is not on the triangle.
    [[nodiscard]] std::optional<CellPiece> at(glm::vec3 cell) const;

  private:
    glm::vec3 normal_{0.0f};  // its largest component is 1
    float offset_ = 0.0f;
    float to_step_ = 0.0f;  // from distance to index in the table
    // Axes by increasing absolute component of the normal, each pointing to the normal's side, and those
    // components.
    std::array<glm::vec3, 3> towards_{};
    glm::vec2 slope_{0.0f};
    glm::vec3 corner_{0.0f};
    std::array<glm::vec3, 2> barycentric_{};  // gradients of two coordinates
    const SectionTable::Section* sections_;
};

}  // namespace voxilux
