#include "bench/rate_ratios.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace voxilux {
namespace {

using Contestants = std::span<const MarchContestant>;

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values.empty() ? 0.0 : 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

bool is_embree(const MarchContestant& contestant) {
    return contestant.row.traversal.starts_with("embree.");
}

// The fastest in the median of those that `is_of` admits for these rays; null when there is none.
template <class Filter>
const MarchContestant* fastest(Contestants contestants, const std::string& rays, const Filter& is_of) {
    const MarchContestant* best = nullptr;
    for (const MarchContestant& one : contestants)
        if (one.row.rays == rays && !one.rates.empty() && is_of(one) &&
            (best == nullptr || median(one.rates) > median(best->rates)))
            best = &one;
    return best;
}

double median_ratio(const MarchContestant& one, const MarchContestant& other) {
    std::vector<double> ratios;
    for (std::size_t turn = 0; turn < one.rates.size(); ++turn)
        ratios.push_back(one.rates[turn] / other.rates[turn]);
    return median(ratios);
}

// The ratios of one structure's rows to the fastest that `is_of` admits, and their mean.
template <class Filter>
std::string line_of(Contestants group, Contestants contestants, const char* over, const Filter& is_of) {
    std::string line;
    double logs = 0.0;
    int count = 0;
    for (const MarchContestant& one : group) {
        const MarchContestant* other = fastest(contestants, one.row.rays, is_of);
        if (one.rates.empty() || other == nullptr) continue;
        const double ratio = median_ratio(one, *other);
        line += fmt::format("  {} {:.2f}", one.row.rays, ratio);
        logs += std::log(ratio);
        ++count;
    }
    if (count == 0) return "";
    return fmt::format("{} {} {} over {}:{}  mean {:.2f}\n", group[0].row.scene, group[0].row.extent,
                       group[0].row.traversal, over, line, std::exp(logs / count));
}

}  // namespace

std::string describe_ratios(Contestants contestants) {
    std::string text;
    for (auto first = contestants.begin(); first != contestants.end();) {
        const auto end = std::find_if(first, contestants.end(), [&](const MarchContestant& other) {
            return other.row.traversal != first->row.traversal;
        });
        const Contestants group(first, end);
        const auto is_baseline = [](const MarchContestant& one) { return one.row.traversal == kBaseline; };
        if (!is_embree(*first)) text += line_of(group, contestants, "Embree", is_embree);
        if (!is_embree(*first)) text += line_of(group, contestants, kBaseline, is_baseline);
        first = end;
    }
    return text;
}

}  // namespace voxilux
