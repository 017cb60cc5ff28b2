#include "voxelize/voxelize_report.h"

#include <sys/resource.h>

#include <algorithm>
#include <set>

#include "base/error.h"
#include "base/printable.h"

namespace voxilux {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

rusage usage_so_far() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage;
}

double cpu_s() {
    const rusage usage = usage_so_far();
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double peak_rss_mib() {
    return static_cast<double>(usage_so_far().ru_maxrss) / 1024.0;
}

double seconds_between(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

std::size_t looks_of(const VoxelPalette& palette) {
    std::set<Look> looks;
    for (const PaletteEntry& entry : palette.entries())
        looks.insert(entry.look);
    return looks.size();
}

const char* name_of(Coverage coverage) {
    return coverage == Coverage::thin ? "thin" : "conservative";
}

Json grid_json(const VoxelizeFacts& facts) {
    const MeshGrid& grid = facts.set.grid;
    return {{"cells", {grid.cells.x, grid.cells.y, grid.cells.z}},
            {"metres_per_voxel", 1.0 / grid.scale},
            {"low", {grid.low.x, grid.low.y, grid.low.z}},
            {"up", facts.command.up},
            {"turn_deg", facts.command.turn_deg}};
}

Json solid_json(const VoxelizeFacts& facts) {
    if (!facts.request.is_solid) return nullptr;
    const SolidReport& solid = facts.set.solid;
    return {{"open_edges", solid.open_edges},
            {"turned_edges", solid.turned_edges},
            {"open_rows", solid.open_rows},
            {"parity_against_winding", solid.disputed}};
}

Json palette_json(const VoxelPalette& palette) {
    const PaletteError& error = palette.error();
    return {{"entries", palette.entries().size()},
            {"looks", looks_of(palette)},
            {"de76_mean", error.mean},
            {"de76_p95", error.p95},
            {"de76_max", error.largest},
            {"radiances_off", error.radiances_off}};
}

Json steps_json(const StepTimes& times) {
    Json steps = Json::array();
    for (const StepTimes::Step& step : times.steps())
        steps.push_back({{"label", step.label}, {"wall_s", step.wall_s}, {"cpu_s", step.cpu_s}});
    return steps;
}

}  // namespace

StepTimes::StepTimes() : start_(Clock::now()), last_(start_), last_cpu_s_(cpu_s()) {}

void StepTimes::end_step(const std::string& label) {
    const Clock::time_point now = Clock::now();
    const double cpu_now_s = cpu_s();
    steps_.push_back({label, seconds_between(last_, now), cpu_now_s - last_cpu_s_});
    last_ = now;
    last_cpu_s_ = cpu_now_s;
}

double StepTimes::wall_s() const {
    return seconds_between(start_, last_);
}

std::string describe(const VoxelizeFacts& facts) {
    const VoxelSet& set = facts.set;
    const MeshGrid& grid = set.grid;
    const PaletteError& error = facts.palette.error();
    std::string text =
        fmt::format("mesh      {} triangles, {} materials, {} textures\n", facts.mesh.triangles.size(),
                    facts.mesh.materials.size(), facts.mesh.textures.size());
    text += fmt::format("grid      {} x {} x {} voxels of {:.6g} m\n", grid.cells.x, grid.cells.y,
                        grid.cells.z, 1.0 / grid.scale);
    text += fmt::format("voxels    {} on the surface ({})", set.surface, name_of(facts.request.coverage));
    if (facts.request.is_solid) text += fmt::format(", {} inside", set.interior);
    if (set.masked != 0) text += fmt::format(", {} left empty by alpha masks", set.masked);
    text += fmt::format(
        "\npalette   {} colours of {} kinds of material, error dE76 {:.2f} mean, {:.2f} at 95 %\n",
        facts.palette.entries().size(), looks_of(facts.palette), error.mean, error.p95);
    text += fmt::format("time      {:.2f} s wall, {:.2f} s CPU, {:.0f} MiB at most\n", facts.times.wall_s(),
                        cpu_s(), peak_rss_mib());
    for (const StepTimes::Step& step : facts.times.steps())
        text += fmt::format("step      {:<9} {:8.2f} s wall {:8.2f} s CPU\n", step.label, step.wall_s,
                            step.cpu_s);
    text += fmt::format("wrote     {}: {} models, {:.1f} MiB\n", printable(facts.output.string(), kUncut),
                        facts.written.models, static_cast<double>(facts.written.bytes) / (1 << 20));
    return text;
}

Json report_json(const VoxelizeFacts& facts) {
    const VoxelSet& set = facts.set;
    return {{"version", VX_VERSION},
            {"command", "voxelize"},
            {"mesh", printable(facts.command.mesh, kUncut)},
            {"output", printable(facts.output.string(), kUncut)},
            {"wall_s", facts.times.wall_s()},
            {"cpu_s", cpu_s()},
            {"peak_rss_mib", peak_rss_mib()},
            {"triangles", facts.mesh.triangles.size()},
            {"materials", facts.mesh.materials.size()},
            {"grid", grid_json(facts)},
            {"coverage", name_of(facts.request.coverage)},
            {"voxels", set.surface + set.interior},
            {"surface", set.surface},
            {"interior", set.interior},
            {"masked", set.masked},
            {"solid", solid_json(facts)},
            {"models", facts.written.models},
            {"bytes", facts.written.bytes},
            {"palette", palette_json(facts.palette)},
            {"steps", steps_json(facts.times)},
            {"warnings", facts.warnings}};
}

}  // namespace voxilux
