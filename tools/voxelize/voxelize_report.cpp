#include "voxelize/voxelize_report.h"

#include <set>

#include "base/error.h"
#include "base/printable.h"
#include "jobs/memory_forecast.h"
#include "jobs/report.h"

namespace voxilux {
namespace {

using Json = nlohmann::ordered_json;

double peak_rss_mib() {
    return static_cast<double>(resident_bytes().peak) / 0x1p20;
}

std::size_t looks_of(const VoxelPalette& palette) {
    std::set<Look> looks;
    for (const PaletteEntry& entry : palette.entries())
        looks.insert(entry.look);
    return looks.size();
}

Json grid_json(const VoxelizeFacts& facts) {
    const MeshGrid& grid = facts.set.grid;
    return {{"cells", {grid.cells.x, grid.cells.y, grid.cells.z}},
            {"metres_per_voxel", 1.0 / grid.scale},
            {"low", {grid.low.x, grid.low.y, grid.low.z}},
            {"up", name_of(up_of(facts.mesh, facts.command.request.grid))},
            {"turn_deg", 90 * facts.command.request.grid.quarter_turns}};
}

Json solid_json(const VoxelizeFacts& facts) {
    if (!facts.command.request.is_solid) return nullptr;
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

}  // namespace

std::string describe(const VoxelizeFacts& facts) {
    const VoxelSet& set = facts.set;
    const MeshGrid& grid = set.grid;
    const PaletteError& error = facts.palette.error();
    const Seconds total = facts.times.total();
    std::string text =
        fmt::format("mesh      {} triangles, {} materials, {} textures\n", facts.mesh.triangles.size(),
                    facts.mesh.materials.size(), facts.mesh.textures.size());
    text += fmt::format("grid      {} x {} x {} voxels of {:.6g} m\n", grid.cells.x, grid.cells.y,
                        grid.cells.z, 1.0 / grid.scale);
    text += fmt::format("voxels    {} on the surface ({})", set.surface,
                        facts.command.thin ? "thin" : "conservative");
    if (facts.command.request.is_solid) text += fmt::format(", {} inside", set.interior);
    if (set.masked != 0) text += fmt::format(", {} left empty by alpha masks", set.masked);
    text += fmt::format(
        "\npalette   {} colours of {} kinds of material, error dE76 {:.2f} mean, {:.2f} at 95 %\n",
        facts.palette.entries().size(), looks_of(facts.palette), error.mean, error.p95);
    text += fmt::format("time      {:.2f} s wall, {:.2f} s CPU, {:.0f} MiB at most\n", total.wall, total.cpu,
                        peak_rss_mib());
    for (const StepTime& step : facts.times.steps())
        text += fmt::format("step      {:<9} {:8.2f} s wall {:8.2f} s CPU\n", step.label, step.time.wall,
                            step.time.cpu);
    text += fmt::format("wrote     {}: {} models, {:.1f} MiB\n", printable(facts.output, kUncut),
                        facts.written.models, static_cast<double>(facts.written.bytes) / (1 << 20));
    return text;
}

Json report_json(const VoxelizeFacts& facts) {
    const VoxelSet& set = facts.set;
    const Seconds total = facts.times.total();
    return {{"version", VX_VERSION},
            {"command", "voxelize"},
            {"mesh", printable(facts.command.mesh, kUncut)},
            {"output", printable(facts.output, kUncut)},
            {"wall_s", total.wall},
            {"cpu_s", total.cpu},
            {"peak_rss_mib", peak_rss_mib()},
            {"triangles", facts.mesh.triangles.size()},
            {"materials", facts.mesh.materials.size()},
            {"grid", grid_json(facts)},
            {"coverage", facts.command.thin ? "thin" : "conservative"},
            {"voxels", set.surface + set.interior},
            {"surface", set.surface},
            {"interior", set.interior},
            {"masked", set.masked},
            {"solid", solid_json(facts)},
            {"models", facts.written.models},
            {"bytes", facts.written.bytes},
            {"palette", palette_json(facts.palette)},
            {"steps", steps_json(facts.times.steps())},
            {"warnings", facts.warnings}};
}

}  // namespace voxilux
