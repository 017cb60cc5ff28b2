#include "scene/alias_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/assert.h"
#include "base/checked_cast.h"

namespace voxilux {
namespace {

// Rounds up, so that whatever has power keeps some.
float round_up(double probability) {
    constexpr double kSteps = 0x1p24;
    return static_cast<float>(std::min(1.0, std::ceil(probability * kSteps) / kSteps));
}

// Each power over their mean; scaled first, so that no sum overflows. Empty when there is no power.
std::vector<double> shares_of(std::span<const double> powers) {
    double largest = 0.0;
    for (const double power : powers) {
        VX_ASSERT(power >= 0.0 && std::isfinite(power));
        largest = std::max(largest, power);
    }
    if (largest == 0.0) return {};
    double sum = 0.0;
    for (const double power : powers)
        sum += power / largest;
    std::vector<double> shares;
    shares.reserve(powers.size());
    for (const double power : powers)
        shares.push_back(power / largest * (static_cast<double>(powers.size()) / sum));
    return shares;
}

void measure_pdf(std::vector<gpu::AliasEntry>& table) {
    std::vector<double> buckets(table.size(), 0.0);
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double keep = table[i].keep;
        buckets[i] += keep;
        buckets[table[i].other] += 1.0 - keep;
    }
    for (std::size_t i = 0; i < table.size(); ++i)
        table[i].pdf = static_cast<float>(buckets[i] / static_cast<double>(table.size()));
}

}  // namespace

std::vector<gpu::AliasEntry> build_alias_table(std::span<const double> powers) {
    std::vector<double> shares = shares_of(powers);
    std::vector<gpu::AliasEntry> table(shares.size());
    std::vector<std::uint32_t> small, large;
    for (std::size_t i = 0; i < shares.size(); ++i)
        (shares[i] < 1.0 ? small : large).push_back(checked_cast<std::uint32_t>(i, "alias entry"));
    // Rounding may empty one list before the other. What is left over is 1 up to rounding, except for entries
    // without power, which give their bucket to the strongest.
    const auto strongest = static_cast<std::uint32_t>(std::ranges::max_element(powers) - powers.begin());
    while (!small.empty() && !large.empty()) {
        const std::uint32_t poor = small.back(), rich = large.back();
        small.pop_back();
        table[poor] = {.keep = round_up(shares[poor]), .other = rich};
        shares[rich] -= 1.0 - shares[poor];
        if (shares[rich] >= 1.0) continue;
        large.pop_back();
        small.push_back(rich);
    }
    for (const std::vector<std::uint32_t>& left : {small, large}) {
        for (const std::uint32_t i : left)
            table[i] = {.keep = powers[i] > 0.0 ? 1.0f : 0.0f, .other = strongest};
    }
    measure_pdf(table);
    return table;
}

}  // namespace voxilux
