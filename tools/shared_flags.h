#pragma once

// Flags that several subcommands have.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "film/tonemap.h"
#include "flags.h"
#include "progress_line.h"
#include "vk/device.h"
#include "voxelizer/mesh_grid.h"

namespace voxilux {

// Where the report goes, and what is printed.
struct ReportOptions {
    std::string json;    // its file; "-": standard output; empty: nowhere
    bool quiet = false;  // errors only

    // Whether lines for people go to standard output.
    [[nodiscard]] bool prints() const { return !quiet && json != "-"; }
};

// --json, which writes `what`, such as "the report".
void add_json_flag(Flags& flags, std::string& json, const std::string& what);
// --json and -q.
void add_report_flags(Flags& flags, ReportOptions& report);
void add_progress_flag(Flags& flags, ProgressMode& mode);

// -o of pictures, each .exr or .png.
Flag add_picture_flag(Flags& flags, std::vector<std::string>& files, const std::string& help);
// --resolution and --up, for meshes and point clouds that become voxels.
void add_mesh_flags(Flags& flags, GridRequest& grid);
// --tone and --exposure.
void add_tone_flags(Flags& flags, ToneMapOptions& tone);

// On which device to work, and how carefully.
struct DeviceOptions {
    std::string selector;  // index or part of a name; empty: the default
    bool no_cache = false;
    bool validation = VX_VALIDATION_DEFAULT;
    bool no_validation = false;

    [[nodiscard]] DeviceRequest request() const {
        return {.selector = selector, .validation = validation && !no_validation};
    }
    // Where pipelines are kept from run to run; empty: nowhere.
    [[nodiscard]] std::filesystem::path cache_dir() const;
};

void add_device_flag(Flags& flags, std::string& selector);
// All of them, and --memory-budget. `caches` says for --help what --no-cache neither reads nor writes.
void add_device_flags(Flags& flags, DeviceOptions& options, std::uint64_t& memory_budget_bytes,
                      const std::string& caches);

}  // namespace voxilux
