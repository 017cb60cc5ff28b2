#include "world/march_world.h"

#include <array>

#include "base/error.h"
#include "world/build_dense.h"
#include "world/build_fields.h"
#include "world/world_view.h"

namespace voxilux {
namespace {

constexpr std::array<std::string_view, kTraversalCount> kNames = {"dda",   "brick4", "brick8",
                                                                  "naadf", "deep",   "wide"};
constexpr std::array<Traversal, kTraversalCount> kAll = {
    Traversal::dda, Traversal::brick4, Traversal::brick8, Traversal::naadf, Traversal::deep, Traversal::wide};

}  // namespace

std::span<const Traversal> all_traversals() {
    return kAll;
}

bool has_free_boxes(Traversal traversal) {
    return gpu::has_free_boxes(static_cast<gpu::uint>(traversal));
}

std::string_view name_of(Traversal traversal) {
    return kNames[static_cast<std::size_t>(traversal)];
}

Traversal traversal_named(std::string_view name) {
    for (std::size_t i = 0; i < kTraversalCount; ++i) {
        if (kNames[i] == name) return static_cast<Traversal>(i);
    }
    throw Error(ExitCode::usage,
                fmt::format("no traversal '{}'; there are {}", name, fmt::join(kNames, ", ")));
}

MarchWorld build_unexpanded_world(const VoxelWorld& world, Traversal traversal) {
    MarchWorld built{.traversal = traversal, .origin = world.origin(), .chunks_size = world.chunks()};
    switch (traversal) {
        case Traversal::dda:
            build_bytes(world, built);
            break;
        case Traversal::brick4:
        case Traversal::brick8:
            build_masks(world, built);
            break;
        default:
            build_unexpanded(world, built);
    }
    return built;
}

MarchWorld build_march_world(const VoxelWorld& world, Traversal traversal) {
    MarchWorld built = build_unexpanded_world(world, traversal);
    grow_boxes(built);
    return built;
}

}  // namespace voxilux
