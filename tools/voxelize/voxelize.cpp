#include "voxelize/voxelize.h"

#include <atomic>
#include <csignal>
#include <filesystem>

#include <CLI/CLI.hpp>

#include "base/error.h"
#include "output_files.h"
#include "voxelize/voxelize_progress.h"
#include "voxelize/voxelize_report.h"
#include "voxelizer/load_mesh.h"
#include "voxelizer/vox_output.h"

namespace voxilux {
namespace {

namespace fs = std::filesystem;

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

// The first signal ends the work between two blocks, the second one the process.
void on_interrupt(int signal) {
    interrupted = true;
    std::signal(signal, SIG_DFL);
}

fs::path output_of(const VoxelizeCommand& command) {
    if (!command.output.empty()) {
        if (!has_ending(command.output, ".vox"))
            throw Error(ExitCode::usage, fmt::format("-o {}: a mesh is written as .vox", command.output));
        return command.output;
    }
    const fs::path own = fs::path(command.mesh).stem().string() + ".vox";
    if (fs::exists(own)) {
        throw Error(ExitCode::usage, fmt::format("voxelize: no -o was given and {} is there already; -o {} "
                                                 "overwrites it",
                                                 own.string(), own.string()));
    }
    return own;
}

VoxelizeRequest request_of(const VoxelizeCommand& command) {
    const auto up = parse_up(command.up);
    if (!up) {
        throw Error(ExitCode::usage, fmt::format("--up: '{}' is not x, y, z, -x, -y or -z", command.up));
    }
    if (command.turn_deg % 90 != 0)
        throw Error(ExitCode::usage, fmt::format("--turn: {} is not a multiple of 90", command.turn_deg));
    if (command.resolution < 1 || command.resolution > kMaxCells) {
        throw Error(ExitCode::usage,
                    fmt::format("--resolution: {} is not from 1 to {}", command.resolution, kMaxCells));
    }
    if (command.scale_m && !(*command.scale_m > 0.0 && *command.scale_m < 1e300))
        throw Error(ExitCode::usage, fmt::format("--scale: {} is not above 0", *command.scale_m));
    return {.grid = {.resolution = command.resolution,
                     .metres_per_voxel = command.scale_m,
                     .up = *up,
                     .quarter_turns = command.turn_deg / 90,
                     .is_on_floor = command.on_floor},
            .coverage = command.thin ? Coverage::thin : Coverage::conservative,
            .is_solid = command.solid,
            .inside = command.parity ? InsideRule::parity : InsideRule::winding,
            .threads = command.threads};
}

void warn_of_solid(const VoxelizeCommand& command, const SolidReport& solid,
                   std::vector<std::string>& warnings) {
    if (solid.open_edges > 0) {
        const std::string outcome = command.parity
                                        ? fmt::format("{} rows of voxels are not filled", solid.open_rows)
                                        : "its inside is where the generalised winding number is above 1/2";
        warnings.push_back(
            fmt::format("the mesh is open: {} edges have no partner, {}", solid.open_edges, outcome));
    }
    if (solid.turned_edges > 0 && !command.parity) {
        warnings.push_back(
            fmt::format("the mesh is not oriented: at {} edges triangles face opposite sides{}",
                        solid.turned_edges, solid.open_edges > 0 ? "" : "; its inside is found by parity"));
    }
    if (solid.disputed > 0 && (command.parity || solid.turned_edges > 0)) {
        warnings.push_back(fmt::format(
            "the mesh overlaps itself: parity and winding number disagree on {} voxels of the inside",
            solid.disputed));
    }
}

// What the user should know, one line each.
std::vector<std::string> warnings_of(const VoxelizeCommand& command, const Mesh& mesh, const VoxelSet& set,
                                     const PaletteError& error) {
    std::vector<std::string> warnings = mesh.warnings;
    if (set.dropped != 0)
        warnings.push_back(
            fmt::format("{} triangles with a vertex that is not finite are left out", set.dropped));
    warn_of_solid(command, set.solid, warnings);
    if (const auto range = range_warning(set.grid)) warnings.push_back(*range);
    if (error.radiances_off > 0) {
        warnings.push_back(
            fmt::format("{} voxels emit over 3 % more or less than the mesh says: 255 colours "
                        "are too few",
                        error.radiances_off));
    }
    return warnings;
}

Mesh read_mesh(const VoxelizeCommand& command) {
    Mesh mesh = load_mesh(command.mesh, {.is_strict = command.strict, .scene = command.scene});
    for (MeshMaterial& material : mesh.materials) {
        if (command.ignore_mask && material.alpha_mode == AlphaMode::mask)
            material.alpha_mode = AlphaMode::opaque;
    }
    return mesh;
}

void refuse_warnings(const VoxelizeCommand& command, const std::vector<std::string>& warnings) {
    if (!command.strict || warnings.empty()) return;
    throw Error(ExitCode::input_refused, fmt::format("{}: {} (--strict)", command.mesh, warnings.front()));
}

}  // namespace

CLI::App* add_voxelize(CLI::App& app, VoxelizeCommand& command) {
    CLI::App* sub = app.add_subcommand("voxelize", "turn a mesh (glTF, GLB, OBJ) into a .vox file");
    sub->add_option("MESH", command.mesh, "a .gltf, .glb or .obj file")->required()->type_name("");
    sub->add_option("-o,--output", command.output, "the .vox file; default: named as MESH, in this folder")
        ->type_name("FILE");
    CLI::Option* resolution =
        sub->add_option("--resolution", command.resolution, "voxels along the longest side of the scene")
            ->type_name("N")
            ->capture_default_str();
    sub->add_option("--scale", command.scale_m, "metres per voxel, instead of --resolution")
        ->type_name("METRES")
        ->excludes(resolution);
    sub->add_option("--up", command.up, "the mesh's axis that points up: x, y, z, -x, -y or -z")
        ->type_name("AXIS")
        ->capture_default_str();
    sub->add_option("--turn", command.turn_deg,
                    "turn about the vertical by a multiple of 90 degrees, counter-clockwise from above")
        ->type_name("DEG");
    sub->add_flag("--thin", command.thin,
                  "fewest voxels without a hole (6-separating), instead of all that the surface touches");
    CLI::Option* solid =
        sub->add_flag("--solid", command.solid, "fill the inside, by winding number: what overlaps is one");
    sub->add_flag("--parity", command.parity, "with --solid: by parity, so that what overlaps is hollow")
        ->needs(solid);
    sub->add_flag("--floor", command.on_floor,
                  "put the lowest voxels at z = 0; default: the middle is at the origin");
    sub->add_flag("--dither", command.dither, "mix palette colours by place");
    sub->add_flag("--ignore-mask", command.ignore_mask, "keep what alpha masks cut away");
    sub->add_option("--scene", command.scene, "which scene of a glTF file, from 0; default: the file's own")
        ->type_name("N");
    sub->add_flag("--strict", command.strict, "what would be a warning is an error");
    sub->add_option("--threads", command.threads, "default: all; the file is the same for any number")
        ->type_name("N");
    sub->add_option("--json", command.json, "write the report as JSON; - is standard output")
        ->type_name("FILE");
    sub->add_option("--progress", command.progress, "auto, never or json, on standard error")
        ->type_name("MODE")
        ->capture_default_str();
    sub->add_flag("-q,--quiet", command.quiet, "print no facts and no progress");
    return sub;
}

int run_voxelize(const VoxelizeCommand& command) {
    StepTimes times;
    VoxelizeRequest request = request_of(command);
    const fs::path output = output_of(command);
    check_writable(output);
    check_writable(command.json);
    VoxelizeProgress progress(command.progress, command.quiet);
    request.progress = [&](double done) {
        if (interrupted) throw Error(ExitCode::interrupted, "interrupted; nothing was written");
        progress.show(done);
    };
    std::signal(SIGINT, on_interrupt);
    std::signal(SIGTERM, on_interrupt);

    const Mesh mesh = read_mesh(command);
    times.end_step("load");
    const VoxelSet set = voxelize_mesh(mesh, request);
    progress.finish();
    times.end_step("voxelize");
    const VoxelPalette palette(set, command.dither);
    times.end_step("palette");
    const std::vector<std::string> warnings = warnings_of(command, mesh, set, palette.error());
    refuse_warnings(command, warnings);
    const VoxOutput written =
        write_voxels(output, set, palette, mesh, fs::path(command.mesh).stem().string());
    times.end_step("write");

    const VoxelizeFacts facts{command, request, mesh, set, palette, written, times, warnings, output};
    for (const std::string& warning : warnings)
        fmt::print(stderr, "voxilux: warning: {}\n", warning);
    if (!command.quiet && command.json != "-") fmt::print("{}", describe(facts));
    write_json(command.json, report_json(facts));
    return static_cast<int>(ExitCode::done);
}

}  // namespace voxilux
