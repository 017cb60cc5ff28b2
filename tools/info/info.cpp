#include "info/info.h"

#include "base/error.h"
#include "base/file.h"
#include "base/print.h"
#include "jobs/file_facts.h"
#include "shared_flags.h"
#include "voxelizer/import_voxels.h"
#include "write_json.h"

namespace voxilux {
namespace {

FileFacts imported_facts(const InfoOptions& options) {
    const ImportedVoxels imported = import_voxels(options.file, options.grid);
    print_message("note: {}\n", imported.note);
    return vox_file_facts(imported.file, options.file);
}

}  // namespace

void add_info_flags(Flags& flags, InfoOptions& options) {
    flags
        .add("FILE", "", options.file,
             "a .vox, .toml, .exr or .png file, voxels of another format (see convert), or a mesh, as voxels")
        .required();
    add_mesh_flags(flags, options.grid);
    add_json_flag(flags, options.json, "the facts");
}

int run_info(const InfoOptions& options) {
    check_outputs({options.json}, {options.file});
    const FileFacts facts = is_importable(options.file) ? imported_facts(options) : file_facts(options.file);
    if (options.json != "-") print_result("{}", facts.text);
    write_json(options.json, facts.json);
    return static_cast<int>(ExitCode::done);
}

}  // namespace voxilux
