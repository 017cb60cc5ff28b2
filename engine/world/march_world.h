#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "shared/world_cell.h"
#include "world/voxel_world.h"

namespace voxilux {

// Structures that a ray can be marched through; shaders/shared/world_cell.h says what each holds. All give
// the same hits.
enum class Traversal : std::uint8_t {
    dda = gpu::kTraversalDda,
    brick4 = gpu::kTraversalBrick4,
    brick8 = gpu::kTraversalBrick8,
    naadf = gpu::kTraversalNaadf,
    deep = gpu::kTraversalDeep,
    wide = gpu::kTraversalWide,
};
inline constexpr std::size_t kTraversalCount = gpu::kTraversalCount;

[[nodiscard]] std::span<const Traversal> all_traversals();

// Whether boxes may reach beyond their parent on every level.
[[nodiscard]] bool has_free_boxes(Traversal traversal);

[[nodiscard]] std::string_view name_of(Traversal traversal);

// The traversal of that name; Error(usage) with the known names when there is none.
[[nodiscard]] Traversal traversal_named(std::string_view name);

// A world in the form that a traversal marches, laid out as the shaders read it.
struct MarchWorld {
    Traversal traversal = Traversal::naadf;
    glm::ivec3 origin{0};              // scene cell of local cell 0
    glm::ivec3 chunks_size{1};         // chunks of 16^3 per axis
    std::vector<std::uint32_t> roots;  // dense, x fastest
    std::vector<std::uint32_t> nodes;
    std::vector<std::uint32_t> leaves;
    // The chunk of each block of 64 nodes.
    std::vector<glm::ivec3> node_homes;

    [[nodiscard]] glm::ivec3 size() const { return chunks_size * 16; }
    [[nodiscard]] std::uint64_t size_bytes() const {
        return 4 * (std::uint64_t{roots.size()} + nodes.size() + leaves.size());
    }
};

// Builds a structure on the CPU. Readable rather than fast: it is the oracle for every other builder. Throws
// Error(out_of_memory) when the structure cannot hold the world (dda: more than 255 materials).
[[nodiscard]] MarchWorld build_march_world(const VoxelWorld& world, Traversal traversal = Traversal::naadf);

// The same before its boxes grow: a march through it is right but slow. The device goes on from here
// (passes/world.h).
[[nodiscard]] MarchWorld build_unexpanded_world(const VoxelWorld& world, Traversal traversal);

}  // namespace voxilux
