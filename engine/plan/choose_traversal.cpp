#include "plan/choose_traversal.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace voxilux {
namespace {

// Most bytes that the structure of a world takes when nobody says otherwise: it leaves a small GPU or laptop
// room for the picture.
constexpr std::uint64_t kWorldBytes = 100'000'000;

// Fastest first, as measured (engine/world/README.md).
constexpr std::array kBySpeed = {Traversal::wide, Traversal::deep, Traversal::naadf};

bool fits(const StructureBytes& bytes, std::uint64_t allowed, const DeviceLimits& limits) {
    const std::uint64_t largest = std::max({bytes.roots, bytes.nodes, bytes.leaves});
    return largest <= limits.max_allocation_bytes && bytes.total() <= allowed;
}

}  // namespace

TraversalChoice choose_traversal(const WorldCensus& census, std::optional<Traversal> request,
                                 std::uint64_t budget_bytes, const DeviceLimits& limits) {
    if (request) return {*request, "by your choice"};
    const std::uint64_t allowed = budget_bytes != 0 ? budget_bytes / 2 : kWorldBytes;
    const auto bytes = [&](Traversal traversal) { return predict_bytes(census, traversal); };
    for (const Traversal traversal : kBySpeed) {
        if (!fits(bytes(traversal), allowed, limits)) continue;
        if (traversal == kBySpeed.front()) return {traversal, "the fastest"};
        return {traversal,
                fmt::format("the fastest within {} MB; '{}' would take {} MB", allowed / 1'000'000,
                            name_of(kBySpeed.front()), bytes(kBySpeed.front()).total() / 1'000'000)};
    }
    const Traversal smallest = *std::ranges::min_element(
        kBySpeed, {}, [&](Traversal traversal) { return bytes(traversal).total(); });
    return {smallest, fmt::format("the smallest; no structure keeps within {} MB", allowed / 1'000'000)};
}

}  // namespace voxilux
