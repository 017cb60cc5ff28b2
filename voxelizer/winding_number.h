#pragma once

// The generalised winding number of a triangle soup about a point: the sum of the solid angles of its
// triangles, divided by that of the sphere. 1 inside a closed surface, 2 where two overlap, 0 outside. Near a
// hole it varies smoothly, and 1/2 is where a surface would close the hole. Source: A. Jacobson, L. Kavan and
// O. Sorkine-Hornung, "Robust Inside-Outside Segmentation using Generalized Winding Numbers", 2013. Triangles
// far from the point count together, as a dipole: G. Barill et al., "Fast Winding Numbers for Soups and
// Clouds", 2018, of which this uses the first order, with a larger distance in place of the second order.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "voxelizer/mesh_grid.h"

namespace voxilux {

class WindingTree {
  public:
    // Positions are those of the lattice, so that triangles share their edges exactly.
    WindingTree(const Mesh& mesh, std::span<const std::uint32_t> triangles,
                std::span<const glm::ivec3> lattice);

    // About a point in voxels that is on no triangle; off by less than 0.01 (see the tests).
    [[nodiscard]] double at(glm::dvec3 point) const;

  private:
    struct Triangle {
        glm::dvec3 a{0.0}, b{0.0}, c{0.0};
    };
    // Nodes follow their parent: the first child directly, the second at `second`; 0 for a leaf.
    struct Node {
        glm::dvec3 centre{0.0};       // of the areas
        glm::dvec3 area_vector{0.0};  // sum of the triangles' normals times their areas
        double radius = 0.0;          // of a sphere around `centre` that contains all triangles
        std::uint32_t first = 0, count = 0;
        std::uint32_t second = 0;
    };

    void build(std::uint32_t first, std::uint32_t count);
    [[nodiscard]] Node summed(std::uint32_t first, std::uint32_t count) const;

    std::vector<Triangle> triangles_;
    std::vector<Node> nodes_;
};

}  // namespace voxilux
