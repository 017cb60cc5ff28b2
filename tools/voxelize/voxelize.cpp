#include "voxelize/voxelize.h"

#include <filesystem>

#include "base/error.h"
#include "base/file.h"
#include "base/print.h"
#include "interrupt.h"
#include "parse_values.h"
#include "voxelize/voxelize_report.h"
#include "voxelizer/load_mesh.h"
#include "voxelizer/vox_output.h"
#include "voxelizer/voxelize_warnings.h"
#include "write_json.h"

namespace voxilux {
namespace {

std::string output_of(const VoxelizeCommand& command) {
    if (!command.output.empty()) return command.output;
    const std::string own = std::filesystem::path(command.mesh).stem().string() + ".vox";
    if (std::filesystem::exists(own)) {
        throw Error(
            ExitCode::usage,
            fmt::format("voxelize: no -o was given and {} is there already; -o {} overwrites it", own, own));
    }
    return own;
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

std::string progress_text(double done, double elapsed_s, bool as_json) {
    const double left_s = done > 0.0 ? elapsed_s * (1.0 - done) / done : 0.0;
    return as_json ? fmt::format("{{\"done\":{:.4f},\"elapsed_s\":{:.3f},\"remaining_s\":{:.3f}}}", done,
                                 elapsed_s, left_s)
                   : fmt::format("voxelize {:5.1f} %  {:.0f} s, about {:.0f} s left", 100.0 * done, elapsed_s,
                                 left_s);
}

std::string checked_output(const std::string& file) {
    if (!has_ending(file, ".vox")) refuse(fmt::format("-o {}: a mesh is written as .vox", file));
    return file;
}

int quarter_turns(int degrees) {
    if (degrees % 90 != 0) refuse(fmt::format("--turn: {} is not a multiple of 90", degrees));
    return degrees / 90;
}

double checked_scale(double metres) {
    if (!(metres > 0.0 && metres < 1e300)) refuse(fmt::format("--scale: {} is not above 0", metres));
    return metres;
}

void add_grid_flags(Flags& flags, GridRequest& grid) {
    add_mesh_flags(flags, grid);
    flags
        .on<double>(
            "--scale", "METRES", [&grid](double metres) { grid.metres_per_voxel = checked_scale(metres); },
            "metres per voxel, instead of --resolution")
        .excludes("--resolution");
    flags.on<int>(
        "--turn", "DEG", [&grid](int degrees) { grid.quarter_turns = quarter_turns(degrees); },
        "turn about the vertical by a multiple of 90 degrees, counter-clockwise from above");
}

}  // namespace

void add_voxelize_flags(Flags& flags, VoxelizeCommand& command) {
    VoxelizeRequest& request = command.request;
    flags.add("MESH", "", command.mesh, "a .gltf, .glb, .obj, .stl or .ply file").required();
    flags.add_parsed("-o,--output", "FILE", command.output, checked_output,
                     "the .vox file; default: named as MESH, in this folder");
    add_grid_flags(flags, request.grid);
    flags.add_switch("--thin", command.thin,
                     "fewest voxels without a hole (6-separating), instead of all that the surface touches");
    flags.add_switch("--solid", request.is_solid, "fill the inside, by winding number: what overlaps is one");
    flags.add_switch("--parity", command.parity, "with --solid: by parity, so that what overlaps is hollow");
    flags.add_switch("--floor", request.grid.is_on_floor,
                     "put the lowest voxels at z = 0; default: the middle is at the origin");
    flags.add_switch("--dither", command.dither, "dither between palette colours");
    flags.add_switch("--ignore-mask", command.ignore_mask, "keep what alpha masks cut away");
    flags.add("--scene", "N", command.scene, "which scene of a glTF file, from 0; default: the file's own");
    flags.add_switch("--strict", command.strict, "treat warnings as errors");
    flags.add("--threads", "N", request.threads, "default: all; the file is the same for any number");
    add_report_flags(flags, command.report);
    add_progress_flag(flags, command.progress);
}

Voxelized voxelize(const VoxelizeCommand& command, StepTimes& times) {
    VoxelizeRequest request = command.request;
    if (command.thin) request.coverage = Coverage::thin;
    if (command.parity && !request.is_solid) refuse("--parity: it is for --solid");
    if (command.parity) request.inside = InsideRule::parity;
    Mesh mesh = read_mesh(command);
    times.end_step("load");
    VoxelSet set = voxelize_mesh(mesh, request);
    times.end_step("voxelize");
    VoxelPalette palette(set, command.dither);
    times.end_step("palette");
    std::vector<std::string> warnings = warnings_of(mesh, set, request.inside, palette.error());
    refuse_warnings(command, warnings);
    return {std::move(mesh), std::move(set), std::move(palette), std::move(warnings)};
}

int run_voxelize(const VoxelizeCommand& command) {
    StepTimes times;
    const std::string output = output_of(command);
    check_outputs({output, command.report.json}, {command.mesh});
    ProgressLine progress(command.progress, command.report.quiet);
    const std::atomic<bool>& is_interrupted = interrupted_by_signal();
    VoxelizeCommand shown = command;
    shown.request.progress = [&](double done) {
        if (is_interrupted) throw Error(ExitCode::interrupted, "interrupted; nothing was written");
        const double elapsed_s = times.total().wall;
        progress.show(done, elapsed_s, [=](bool as_json) { return progress_text(done, elapsed_s, as_json); });
    };
    const Voxelized made = voxelize(shown, times);
    progress.finish();
    const VoxOutput written = write_voxels(output, made.set, made.palette, made.mesh,
                                           std::filesystem::path(command.mesh).stem().string());
    times.end_step("write");

    const VoxelizeFacts facts{command, made.mesh, made.set,      made.palette,
                              written, times,     made.warnings, output};
    for (const std::string& warning : made.warnings)
        print_message("voxilux: warning: {}\n", warning);
    if (command.report.prints()) print_result("{}", describe(facts));
    write_json(command.report.json, report_json(facts));
    return static_cast<int>(ExitCode::done);
}

}  // namespace voxilux
