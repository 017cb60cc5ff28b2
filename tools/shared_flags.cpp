#include "shared_flags.h"

#include <algorithm>
#include <limits>

#include "base/error.h"
#include "base/user_folders.h"
#include "jobs/picture_files.h"
#include "parse_values.h"

namespace voxilux {
namespace {

constexpr std::int64_t kMaxMib = std::int64_t{1} << 40;

UpAxis checked_up(const std::string& word) {
    if (const auto up = parse_up(word)) return *up;
    refuse(fmt::format("--up: '{}' is not x, y, z, -x, -y or -z", word));
}

}  // namespace

void add_json_flag(Flags& flags, std::string& json, const std::string& what) {
    flags.add("--json", "FILE", json, fmt::format("write {} as JSON; - is standard output", what));
}

void add_report_flags(Flags& flags, ReportOptions& report) {
    add_json_flag(flags, report.json, "the report");
    flags.add_switch("-q,--quiet", report.quiet, "print errors only");
}

void add_progress_flag(Flags& flags, ProgressMode& mode) {
    flags.add_parsed("--progress", "auto|never|json", mode, parse_progress,
                     "progress on standard error; auto: if it is a terminal");
}

Flag add_picture_flag(Flags& flags, std::vector<std::string>& files, const std::string& help) {
    const auto take = [&files](const std::vector<std::string>& given) {
        for (const std::string& file : given) {
            if (!is_exr(file) && !is_png(file))
                throw Error(ExitCode::usage, fmt::format("-o {}: the ending must be .exr or .png", file));
        }
        files = given;
    };
    return flags.on<std::vector<std::string>>("-o,--output", "FILE", take, help);
}

void add_mesh_flags(Flags& flags, GridRequest& grid) {
    flags
        .on<int>(
            "--resolution", "N",
            [&grid](int cells) {
                grid.resolution = static_cast<int>(checked_range("--resolution", cells, 1, kMaxCells));
            },
            "voxels along the longest side of a mesh")
        .shows(fmt::format("{}", grid.resolution));
    flags.add_parsed("--up", "AXIS", grid.up, checked_up,
                     "the axis of a mesh that points up: x, y, z, -x, -y or -z; default: y, or z in .stl, "
                     ".ply, .xyz and .las");
}

void add_tone_flags(Flags& flags, ToneMapOptions& tone) {
    flags.add_parsed("--tone", "filmic|plain", tone.curve, parse_tone,
                     "tone curve of a PNG (default filmic)");
    flags.on<std::string>(
        "--exposure", "EV|auto",
        [&tone](const std::string& text) {
            tone.exposure_ev = parse_exposure(text);
            tone.is_exposure_given = true;
        },
        "exposure of a PNG in stops (default 0, or the file's); auto shows its mean as middle grey");
}

std::filesystem::path DeviceOptions::cache_dir() const {
    return no_cache ? std::filesystem::path() : cache_folder();
}

void add_device_flag(Flags& flags, std::string& selector) {
    flags.add("--device", "NAME", selector, "index or part of the name, see voxilux devices");
}

void add_device_flags(Flags& flags, DeviceOptions& options, std::uint64_t& memory_budget_bytes,
                      const std::string& caches) {
    flags.begin_group("Device");
    add_device_flag(flags, options.selector);
    flags.on<std::int64_t>(
        "--memory-budget", "N",
        [&memory_budget_bytes](std::int64_t mib) {
            const std::int64_t checked = checked_range("--memory-budget", mib, 0, kMaxMib);
            memory_budget_bytes = static_cast<std::uint64_t>(checked) << 20;
        },
        "maximum device memory, in MiB; 0 is no limit (default 0)");
    flags.add_switch("--no-cache", options.no_cache, fmt::format("neither read nor write {}", caches));
    flags.add_switch("--validation", options.validation, "run under the Vulkan validation layers");
    flags.add_switch("--no-validation", options.no_validation, "run without them");
}

}  // namespace voxilux
