#include "jobs/bench/ao_row.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "jobs/or_null.h"

namespace voxilux {
namespace {

// Columns of times. Brute force has ao.trace in place of ao.sample.
constexpr std::array<std::string_view, 8> kPasses = {"ao.age",    "ao.lookup",  "ao.reproject", "ao.search",
                                                     "ao.sample", "ao.resolve", "ao.filter",    "ao.trace"};

std::string time_of(const AoRow& row, std::string_view label) {
    const auto found = std::ranges::find(row.passes, label, &AoPassTime::label);
    return found == row.passes.end() ? "-" : fmt::format("{:.2f}", found->ms);
}

std::string heading_of(const AoRow& row) {
    std::string text = fmt::format(
        "scene     {}, {}: {} frames, {} per pixel; the reference has an error of {:.4f} at most\n",
        row.scene, row.motion, row.frames,
        row.rays_per_pixel == 1 ? "1 ray" : fmt::format("{} rays", row.rays_per_pixel), row.reference_noise);
    text += fmt::format("{:<13} {:>7}", "variant, ms", "ao");
    for (const std::string_view label : kPasses)
        text += fmt::format(" {:>9}", label.substr(3));
    text += fmt::format(" {:>7} {:>8} {:>8} {:>6} {:>8} {:>7} {:>6}", "CPU", "rays", "searched", "probes",
                        "atomics", "cells", "load");
    for (const AoError& error : row.errors)
        text += fmt::format(" {:>8}", fmt::format("rmse@{}", error.frame));
    return text + fmt::format(" {:>10}\n", "flicker");
}

std::string line_of(const AoRow& row) {
    std::string text = fmt::format("{:<13} {:>7.2f}", row.variant, row.ao_ms());
    for (const std::string_view label : kPasses)
        text += fmt::format(" {:>9}", time_of(row, label));
    text +=
        fmt::format(" {:>7.1f} {:>8.0f} {:>7.2f}% {:>6.2f} {:>8.0f} {:>7} {:>5.1f}%", row.cpu_ms, row.rays,
                    row.searched_percent, row.probes_per_search, row.atomics, row.cells, 100.0 * row.load);
    for (const AoError& error : row.errors)
        text += fmt::format(" {:>8.5f}", error.rmse);
    text +=
        row.flicker ? fmt::format(" {:>6.3f}/255\n", 255.0 * *row.flicker) : fmt::format(" {:>10}\n", "-");
    if (row.table_full > 0.0)
        text += fmt::format("{:<13} {:.1f} hits a frame find no slot\n", "", row.table_full);
    return text;
}

}  // namespace

double AoRow::ao_ms() const {
    double sum = 0.0;
    for (const AoPassTime& pass : passes)
        sum += pass.ms;
    return sum;
}

nlohmann::ordered_json to_json(const AoRow& row) {
    nlohmann::ordered_json passes = nlohmann::ordered_json::object();
    for (const AoPassTime& pass : row.passes)
        passes[pass.label] = pass.ms;
    nlohmann::ordered_json errors = nlohmann::ordered_json::array();
    for (const AoError& error : row.errors)
        errors.push_back({{"frame", error.frame}, {"rmse", error.rmse}});
    return {{"scene", row.scene},
            {"motion", row.motion},
            {"variant", row.variant},
            {"frames", row.frames},
            {"rays_per_pixel", row.rays_per_pixel},
            {"ao_ms", row.ao_ms()},
            {"passes_ms", std::move(passes)},
            {"cpu_ms", row.cpu_ms},
            {"rays", row.rays},
            {"searched_percent", row.searched_percent},
            {"probes_per_search", row.probes_per_search},
            {"atomics", row.atomics},
            {"table_full", row.table_full},
            {"cells", row.cells},
            {"load", row.load},
            {"errors", std::move(errors)},
            {"reference_noise", row.reference_noise},
            {"flicker", or_null(row.flicker)}};
}

std::string describe(std::span<const AoRow> rows) {
    std::string text;
    std::string motion;
    for (const AoRow& row : rows) {
        if (row.motion != motion) {
            if (!text.empty()) text.push_back('\n');
            text += heading_of(row);
            motion = row.motion;
        }
        text += line_of(row);
    }
    return text;
}

}  // namespace voxilux
