#include "jobs/bench/photon_row.h"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "estimators/log_line.h"
#include "jobs/or_null.h"

namespace voxilux {
namespace {

// Columns of times. `sort` puts photons, or points where photons are splatted, into order; `find` brings the
// two together.
constexpr std::array<std::string_view, 7> kColumns = {"camera", "direct", "emit", "trace",
                                                      "sort",   "find",   "rest"};
// The first prefix that matches a pass gives its column.
constexpr std::array<std::pair<std::string_view, std::string_view>, 11> kColumnOf = {
    {{"primary.", "camera"},
     {"sphere.", "camera"},
     {"specular.", "camera"},
     {"direct.", "direct"},
     {"photon.emit", "emit"},
     {"photon.trace", "trace"},
     {"photon.scan", "sort"},
     {"photon.sort", "sort"},
     {"photon.point", "sort"},
     {"photon.place", "sort"},
     {"photon.", "find"}}};

std::string_view column_of(std::string_view label) {
    for (const auto& [begin, column] : kColumnOf)
        if (label.starts_with(begin)) return column;
    return "rest";
}

double time_in(const PhotonRow& row, std::string_view column) {
    double sum = 0.0;
    for (const auto& [label, ms] : row.passes_ms)
        if (column_of(label) == column) sum += ms;
    return sum;
}

std::string heading_of(const PhotonRow& row) {
    std::string text = fmt::format("scene     {}, {}: radius {:g}, alpha {:.4g}; ms of an iteration\n",
                                   row.scene, row.series, row.radius, row.alpha);
    text += fmt::format("{:<12} {:>8} {:>9} {:>6} {:>8} {:>8} {:>8}", "variant", "photons", "size", "iter",
                        "wall s", "CPU s", "M/s");
    for (const std::string_view column : kColumns)
        text += fmt::format(" {:>7}", column);
    text += fmt::format(" {:>8} {:>8}", "stored", "segments");
    if (row.errors) text += fmt::format(" {:>8} {:>8} {:>8}", "relmse", "mean off", "floor");
    return text + "\n";
}

std::string errors_of(const PhotonErrors& errors) {
    double off = 0.0;
    for (const double bias : errors.bias)
        off = std::max(off, std::abs(bias));
    const std::string floor = errors.floor ? fmt::format("{:.5f}", *errors.floor) : "-";
    return fmt::format(" {:>8.5f} {:>7.3f}% {:>8}", errors.relmse, 100.0 * off, floor);
}

std::string line_of(const PhotonRow& row) {
    const double photons = static_cast<double>(row.photons) * row.iterations;
    std::string text = fmt::format("{:<12} {:>8} {:>9} {:>6} {:>8.3f} {:>8.3f} {:>8.3f}", row.variant.name,
                                   row.photons, fmt::format("{}x{}", row.size.x, row.size.y), row.iterations,
                                   row.wall_s, row.cpu_s, 1e-6 * row.photons_per_s());
    for (const std::string_view column : kColumns)
        text += fmt::format(" {:>7.2f}", time_in(row, column));
    text += fmt::format(" {:>8.3f} {:>8.3f}", static_cast<double>(row.stored) / photons,
                        static_cast<double>(row.segments) / photons);
    text += (row.errors ? errors_of(*row.errors) : "") + "\n";
    if (row.faults != 0) text += fmt::format("{:<12} {} faults: the picture is wrong\n", "", row.faults);
    return text;
}

std::string line_of(const PhotonGrowth& growth) {
    if (!growth.wall) return "";
    std::string text = fmt::format("exponent  of {}: wall {:.2f}", growth.series, *growth.wall);
    for (const auto& [label, exponent] : growth.passes)
        text += fmt::format(", {} {:.2f}", label, exponent);
    return text + "\n";
}

double grown(const PhotonRow& row) {
    if (row.series == "photons") return row.photons;
    if (row.series == "iterations") return row.iterations;
    return static_cast<double>(row.size.x) * row.size.y;
}

std::optional<double> exponent_of(std::span<const double> x, std::span<const double> y) {
    const std::optional<LogLine> line = fit_log_line(x, y);
    return line ? std::optional(line->slope) : std::nullopt;
}

}  // namespace

double PhotonRow::photons_per_s() const {
    return static_cast<double>(photons) * iterations / wall_s;
}

PhotonGrowth growth_of(std::span<const PhotonRow> rows) {
    VX_ASSERT(!rows.empty());
    PhotonGrowth growth{.scene = rows.front().scene, .series = rows.front().series};
    std::vector<double> sizes, walls;
    std::map<std::string, std::vector<double>> times;
    for (const PhotonRow& row : rows) {
        sizes.push_back(grown(row));
        walls.push_back(row.wall_s);
        for (const auto& [label, ms] : row.passes_ms)
            times[label].push_back(ms * row.iterations);
    }
    if (growth.series == "options") return growth;
    growth.wall = exponent_of(sizes, walls);
    for (const auto& [label, ms] : times) {
        if (ms.size() != sizes.size()) continue;
        if (const auto exponent = exponent_of(sizes, ms)) growth.passes[label] = *exponent;
    }
    return growth;
}

nlohmann::ordered_json to_json(const PhotonRow& row) {
    nlohmann::ordered_json json = {{"scene", row.scene},
                                   {"series", row.series},
                                   {"variant", row.variant.name},
                                   {"photons", row.photons},
                                   {"size", {row.size.x, row.size.y}},
                                   {"iterations", row.iterations},
                                   {"radius", row.radius},
                                   {"alpha", row.alpha},
                                   {"method", row.variant.scatter ? "scatter" : "gather"},
                                   {"classic", row.variant.classic},
                                   {"roulette", row.variant.roulette},
                                   {"wall_s", row.wall_s},
                                   {"cpu_s", row.cpu_s},
                                   {"photons_per_s", row.photons_per_s()},
                                   {"passes_ms", row.passes_ms},
                                   {"stored", row.stored},
                                   {"segments", row.segments},
                                   {"faults", row.faults},
                                   {"relmse", nullptr},
                                   {"mean_off", nullptr},
                                   {"floor", nullptr}};
    if (!row.errors) return json;
    json["relmse"] = row.errors->relmse;
    json["mean_off"] = row.errors->bias;
    json["floor"] = or_null(row.errors->floor);
    return json;
}

nlohmann::ordered_json to_json(const PhotonGrowth& growth) {
    return {{"scene", growth.scene},
            {"series", growth.series},
            {"wall", or_null(growth.wall)},
            {"passes", growth.passes}};
}

std::string describe(std::span<const PhotonRow> rows) {
    if (rows.empty()) return "";
    std::string text = heading_of(rows.front());
    for (const PhotonRow& row : rows)
        text += line_of(row);
    return text + line_of(growth_of(rows));
}

}  // namespace voxilux
