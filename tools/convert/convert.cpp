#include "convert/convert.h"

#include "base/error.h"
#include "base/file.h"
#include "base/print.h"
#include "base/printable.h"
#include "formats/vox_read.h"
#include "formats/vox_write.h"
#include "parse_values.h"
#include "voxelizer/import_voxels.h"

namespace voxilux {
namespace {

std::string vox_output(const std::string& file) {
    if (!has_ending(file, ".vox")) refuse(fmt::format("convert: {} must end in .vox", file));
    return file;
}

VoxFile read_input(const ConvertCommand& command) {
    if (has_ending(command.input, ".vox")) return load_vox(command.input);
    if (!is_importable(command.input))
        throw Error(ExitCode::input_refused,
                    fmt::format("{}: convert reads .vox, {}", printable(command.input, kUncut),
                                importable_endings()));
    ImportedVoxels imported = import_voxels(command.input, command.grid);
    if (!command.quiet) print_message("note: {}\n", imported.note);
    return std::move(imported.file);
}

}  // namespace

void add_convert_flags(Flags& flags, ConvertCommand& command) {
    flags.add("INPUT", "", command.input, fmt::format("a file {}", importable_endings() + " or .vox"))
        .required();
    flags.add_parsed("OUTPUT", "", command.output, vox_output, "the .vox file").required();
    add_resolution_flag(flags, command.grid);
    flags.add_switch("-q,--quiet", command.quiet, "print warnings and errors only");
}

int run_convert(const ConvertCommand& command) {
    check_outputs({command.output}, {command.input});
    const VoxFile file = read_input(command);
    for (const std::string& warning : file.warnings)
        print_message("voxilux: warning: {}\n", warning);
    write_file_atomically(command.output, write_vox(file));
    return static_cast<int>(ExitCode::done);
}

}  // namespace voxilux
