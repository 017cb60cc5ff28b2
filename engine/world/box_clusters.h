#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include <glm/glm.hpp>

namespace voxilux {

// All points at most `radius` from a box, local to the world, voxels: a box of voxels, or the ball of a
// sphere.
struct RoundedBox {
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};
    double radius = 0.0;

    bool operator==(const RoundedBox&) const = default;
};

// Things of a few kinds, merged in the blocks of a cubic grid, the finest of them by powers of two that
// leaves at most so many. What results does not depend on the order in which things are added.
class BoxClusters {
  public:
    explicit BoxClusters(std::size_t most) : most_(most) {}

    // `most` leaves room for eight blocks, around the origin, of each kind.
    void add(std::uint32_t kind, glm::ivec3 place, const RoundedBox& box);

    struct Cluster {
        std::uint32_t kind = 0;
        RoundedBox box;  // around all that is in it
    };
    // In an order of their own.
    [[nodiscard]] std::vector<Cluster> clusters() const;
    // The number in clusters() of the one that holds what was added with this kind and place.
    [[nodiscard]] std::uint32_t number_of(std::uint32_t kind, glm::ivec3 place) const;

  private:
    using Key = std::array<int, 4>;  // kind, block
    [[nodiscard]] Key key_of(std::uint32_t kind, glm::ivec3 place) const;
    void coarsen();

    std::size_t most_;
    int shift_ = 0;  // blocks are 2^shift voxels wide
    std::map<Key, RoundedBox> boxes_;
};

}  // namespace voxilux
