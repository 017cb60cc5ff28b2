#include "convert/convert.h"

#include "base/error.h"
#include "base/file.h"
#include "base/print.h"
#include "base/printable.h"
#include "formats/vox_read.h"
#include "formats/vox_write.h"
#include "parse_values.h"
#include "standard_streams.h"
#include "voxelizer/glb_output.h"
#include "voxelizer/import_voxels.h"

namespace voxilux {
namespace {

std::string checked_voxel_output(const std::string& file) {
    if (file == kStandardStream) return file;
    if (!has_ending(file, ".vox") && !has_ending(file, ".glb"))
        refuse(fmt::format("convert: {} must end in .vox or .glb, or be -", file));
    return file;
}

VoxFile read_input(const ConvertCommand& command) {
    if (has_ending(command.input, ".vox")) return load_vox(command.input);
    if (command.input == kStandardStream) {
        auto file = read_vox(read_standard_input());
        if (!file) throw Error(ExitCode::input_refused, fmt::format("standard input: {}", file.reason()));
        return std::move(file).value();
    }
    if (!is_importable(command.input))
        throw Error(ExitCode::input_refused,
                    fmt::format("{}: convert reads .vox, {}", printable(command.input, kUncut),
                                importable_endings()));
    ImportedVoxels imported = import_voxels(command.input, command.grid);
    if (!command.quiet) print_message("note: {}\n", imported.note);
    return std::move(imported.file);
}

std::vector<std::byte> mesh_of(const ConvertCommand& command, const VoxFile& file) {
    GlbOutput mesh = glb_of(file);
    if (!command.quiet)
        print_message("note: {}: {} voxels became {} rectangles\n", printable(command.output, kUncut),
                      mesh.voxels, mesh.quads);
    return std::move(mesh.bytes);
}

}  // namespace

void add_convert_flags(Flags& flags, ConvertCommand& command) {
    flags
        .add("INPUT", "", command.input,
             fmt::format("a file {}", importable_endings() + " or .vox; - is a .vox file on standard input"))
        .required();
    flags
        .add_parsed(
            "OUTPUT", "", command.output, checked_voxel_output,
            "the .vox file, or a .glb file: a mesh of few rectangles with the palette as its texture; "
            "- is a .vox file on standard output")
        .required();
    add_mesh_flags(flags, command.grid);
    flags.add_switch("-q,--quiet", command.quiet, "print warnings and errors only");
}

int run_convert(const ConvertCommand& command) {
    check_outputs({command.output}, {command.input});
    const VoxFile file = read_input(command);
    for (const std::string& warning : file.warnings)
        print_message("voxilux: warning: {}\n", warning);
    const bool is_mesh_wanted = has_ending(command.output, ".glb");
    const std::vector<std::byte> bytes = is_mesh_wanted ? mesh_of(command, file) : write_vox(file);
    if (command.output == kStandardStream)
        write_standard_output(bytes);
    else
        write_file_atomically(command.output, bytes);
    return static_cast<int>(ExitCode::done);
}

}  // namespace voxilux
