#include "jobs/bench/bench_row.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace voxilux {
namespace {

using Rows = std::vector<const BenchRow*>;

// The rows of each traversal, in order of first appearance.
std::vector<Rows> by_traversal(std::span<const BenchRow> rows) {
    std::vector<Rows> groups;
    for (const BenchRow& row : rows) {
        const auto known = std::ranges::find_if(
            groups, [&](const Rows& group) { return group.front()->traversal == row.traversal; });
        if (known == groups.end())
            groups.push_back({&row});
        else
            known->push_back(&row);
    }
    return groups;
}

const BenchRow* find_rays(const Rows& rows, const std::string& rays) {
    const auto found = std::ranges::find_if(rows, [&](const BenchRow* row) { return row->rays == rays; });
    return found == rows.end() ? nullptr : *found;
}

// Geometric mean of the rates relative to the baseline's, over the kinds of rays that both have run.
std::optional<double> relative_rate(const Rows& rows, const Rows& baseline) {
    double sum = 0.0;
    int count = 0;
    for (const BenchRow* row : rows) {
        const BenchRow* other = find_rays(baseline, row->rays);
        if (other == nullptr || !(other->mrays_per_cpu_s > 0.0) || !(row->mrays_per_cpu_s > 0.0)) continue;
        sum += std::log(row->mrays_per_cpu_s / other->mrays_per_cpu_s);
        ++count;
    }
    if (count == 0) return {};
    return std::exp(sum / count);
}

// The kinds of rays, in order of first appearance.
std::vector<std::string> kinds_of(std::span<const BenchRow> rows) {
    std::vector<std::string> kinds;
    for (const BenchRow& row : rows)
        if (std::ranges::find(kinds, row.rays) == kinds.end()) kinds.push_back(row.rays);
    return kinds;
}

std::string seconds(std::optional<double> value) {
    return value ? fmt::format("{:.2f}", *value) : "-";
}

std::string line_of(const Rows& rows, const std::vector<std::string>& kinds, const Rows& baseline) {
    const BenchRow& first = *rows.front();
    if (!first.reason.empty()) return fmt::format("{:<18} does not fit: {}\n", first.traversal, first.reason);
    std::string line = fmt::format("{:<18} {:>9.2f} {:>8} {:>8}", first.traversal,
                                   static_cast<double>(first.memory_bytes) / (1 << 20),
                                   seconds(first.build_s), seconds(first.device_build_s));
    for (const std::string& kind : kinds) {
        const BenchRow* row = find_rays(rows, kind);
        line += row == nullptr ? fmt::format("  {:24}", "")
                               : fmt::format("  {:>8.2f} {:>7.2f} {:>7.1f}", row->mrays_per_cpu_s,
                                             row->mrays_per_s, row->steps);
    }
    const std::optional<double> relative = relative_rate(rows, baseline);
    return line + (relative ? fmt::format("  {:>6.2f}\n", *relative) : "       -\n");
}

std::string heading_of(const std::vector<std::string>& kinds) {
    std::string first = fmt::format("{:<18} {:>9} {:>17}", "", "structure", "build, s");
    std::string second = fmt::format("{:<18} {:>9} {:>8} {:>8}", "traversal", "MiB", "CPU", "device");
    for (const std::string& kind : kinds) {
        first += fmt::format("  {:^24}", kind + ", Mray/s");
        second += fmt::format("  {:>8} {:>7} {:>7}", "CPU", "wall", "steps");
    }
    return fmt::format("{}  {:>6}\n{}  {:>6}\n", first, "over", second, kBaseline);
}

std::string checks_of(const Rows& rows) {
    std::string text = "rays      ";
    for (const BenchRow* row : rows)
        text += fmt::format("{}{} {} ({} checked)", row == rows.front() ? "" : ", ", row->count, row->rays,
                            row->checked);
    return text + "\n";
}

}  // namespace

nlohmann::ordered_json to_json(const BenchRow& row) {
    nlohmann::ordered_json json = {{"scene", row.scene},
                                   {"extent", row.extent},
                                   {"traversal", row.traversal},
                                   {"rays", row.rays},
                                   {"fits", row.reason.empty()}};
    if (!row.reason.empty()) {
        json["reason"] = row.reason;
        return json;
    }
    json["count"] = row.count;
    json["mrays_per_cpu_s"] = row.mrays_per_cpu_s;
    json["mrays_per_s"] = row.mrays_per_s;
    json["steps"] = row.steps;
    json["memory_bytes"] = row.memory_bytes;
    if (row.build_s) json["build_s"] = *row.build_s;
    if (row.device_build_s) json["device_build_s"] = *row.device_build_s;
    json["checked"] = row.checked;
    json["mismatches"] = row.mismatches;
    return json;
}

std::string describe(std::span<const BenchRow> rows) {
    if (rows.empty()) return "";
    const std::vector<Rows> groups = by_traversal(rows);
    const std::vector<std::string> kinds = kinds_of(rows);
    const auto ran =
        std::ranges::find_if(groups, [](const Rows& group) { return group.front()->reason.empty(); });
    std::string text = fmt::format("scene     {}, extent {}\n", rows.front().scene, rows.front().extent);
    if (ran != groups.end()) text += checks_of(*ran) + heading_of(kinds);
    const auto baseline =
        std::ranges::find_if(groups, [](const Rows& group) { return group.front()->traversal == kBaseline; });
    for (const Rows& group : groups)
        text += line_of(group, kinds, baseline == groups.end() ? Rows{} : *baseline);
    for (const BenchRow& row : rows) {
        if (row.mismatches != 0)
            text += fmt::format("{} {}: {} of {} rays meet another voxel than they should\n", row.traversal,
                                row.rays, row.mismatches, row.checked);
    }
    return text;
}

}  // namespace voxilux
