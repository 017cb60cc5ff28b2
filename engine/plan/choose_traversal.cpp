#include "plan/choose_traversal.h"

#include <algorithm>

#include <fmt/format.h>

namespace voxilux {
namespace {

// Most bytes of the structure of a world where the user sets no budget: a small GPU or laptop still has room
// for the image.
constexpr std::uint64_t kWorldBytes = 100'000'000;

// Largest grid of bricks, bytes, with which 'wide' is the fastest. Above it, its look-ups miss the cache, and
// 'deep' with its small grid of chunks wins (engine/world/README.md).
constexpr std::uint64_t kCachedRootBytes = std::uint64_t{8} << 20;

bool fits(const StructureBytes& bytes, std::uint64_t allowed, const DeviceLimits& limits) {
    const std::uint64_t largest = std::max({bytes.roots, bytes.nodes, bytes.leaves});
    return largest <= max_world_array_bytes(limits) && bytes.total() <= allowed;
}

}  // namespace

TraversalChoice choose_traversal(const WorldCensus& census, std::optional<Traversal> request,
                                 std::uint64_t budget_bytes, const DeviceLimits& limits) {
    if (request) return {*request, "by your choice"};
    const std::uint64_t allowed = budget_bytes != 0 ? budget_bytes / 2 : kWorldBytes;
    const auto bytes = [&](Traversal traversal) { return predict_bytes(census, traversal); };
    const bool is_small = bytes(Traversal::wide).roots <= kCachedRootBytes;
    const Traversal fastest = is_small ? Traversal::wide : Traversal::deep;
    for (const Traversal traversal : {fastest, Traversal::deep, Traversal::naadf}) {
        if (!fits(bytes(traversal), allowed, limits)) continue;
        if (traversal == fastest) return {traversal, "the fastest for a world of this size"};
        return {traversal, fmt::format("the fastest within {} MB; '{}' may take {} MB", allowed / 1'000'000,
                                       name_of(fastest), bytes(fastest).total() / 1'000'000)};
    }
    return {Traversal::naadf,
            fmt::format("the smallest; no structure is sure to fit in {} MB", allowed / 1'000'000)};
}

}  // namespace voxilux
