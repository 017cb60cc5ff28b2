#include "base/error.h"
#include "bench/bench.h"
#include "parse_values.h"
#include "shared_flags.h"

namespace voxilux {
namespace {

constexpr int kMaxRounds = 1000;
constexpr int kMaxFrames = 4096;
constexpr int kMaxIterations = 1 << 20;
constexpr int kMaxReferenceRays = 65535;  // that a pixel takes for one sample

void add_input_flags(Flags& flags, BenchInputs& inputs, const std::string& files) {
    flags.add("INPUT", "", inputs.files, files);
    flags.add_parsed("--size", "WxH", inputs.size, parse_size,
                     fmt::format("picture size in pixels (default {}x{})", inputs.size.x, inputs.size.y));
    flags.add("--seed", "N", inputs.seed, "seed of every random stream (default 0)");
    add_device_flag(flags, inputs.device);
    add_json_flag(flags, inputs.json, "the rows");
}

// A whole number from 1 up to `max`.
template <class T>
void add_count(Flags& flags, const std::string& name, T& count, int max, const std::string& help) {
    flags.on<std::int64_t>(
        name, "N",
        [&count, name, max](std::int64_t value) {
            count = static_cast<T>(checked_range(name, value, 1, max));
        },
        fmt::format("{} (default {})", help, count));
}

Builder parse_builder(const std::string& name) {
    if (name == "cpu") return Builder::cpu;
    if (name == "device") return Builder::device;
    if (name == "both") return Builder::both;
    throw Error(ExitCode::usage, fmt::format("--build: '{}' is not cpu, device or both", name));
}

int checked_extent(int extent) {
    if (extent >= kMinExtent && extent <= kMaxExtent && extent % 16 == 0) return extent;
    throw Error(ExitCode::usage, fmt::format("--extent: {} is not a multiple of 16 from {} to {}", extent,
                                             kMinExtent, kMaxExtent));
}

void add_growth_flag(Flags& flags, std::vector<std::string>& growth) {
    const auto take = [&growth](const std::vector<std::string>& words) {
        growth.clear();
        for (const std::string& word : words) {
            const bool is_known = std::ranges::find(photon_series(), word) != photon_series().end();
            if (!is_known && word != "none")
                throw Error(ExitCode::usage, fmt::format("--growth: there is no '{}'; there are {}, none",
                                                         word, fmt::join(photon_series(), ", ")));
            if (is_known && std::ranges::find(growth, word) == growth.end()) growth.push_back(word);
        }
    };
    flags
        .on<std::vector<std::string>>("--growth", "NAME,...", take,
                                      "what grows: photons, size, iterations, or none (default all)")
        .split_at_commas();
}

}  // namespace

void add_bench_march_flags(Flags& flags, BenchMarchCommand& command) {
    MarchBenchOptions& options = command.options;
    add_input_flags(flags, command.inputs, ".vox and scene files (default: procedural worlds)");
    flags
        .on<std::vector<int>>(
            "--extent", "N,...",
            [&command](const std::vector<int>& extents) {
                for (const int extent : extents)
                    command.extents.push_back(checked_extent(extent));
            },
            "edges of procedural worlds, in voxels (default 256,512)")
        .split_at_commas();
    flags.add_list("--rays", "KIND,...", options.kinds, ray_kind_named, "primary, ao and long (default all)");
    add_count(flags, "--rounds", options.rounds, kMaxRounds, "number of runs; the best one counts");
    flags.add_list("--traversal", "NAME,...", options.traversals, traversal_named,
                   "structures to march through (default all)");
    flags.add_parsed("--build", "WHO", options.builder, parse_builder,
                     "what builds the structures: cpu, device, or both to compare their bits (default cpu)");
}

void add_bench_ao_flags(Flags& flags, BenchAoCommand& command) {
    AoBenchOptions& options = command.options;
    add_input_flags(flags, command.inputs, ".vox and scene files (default: a procedural world)");
    flags.on<int>(
        "--extent", "N", [&command](int extent) { command.extent = checked_extent(extent); },
        "edge of the procedural world, in voxels (default 256)");
    flags.add_list("--variant", "NAME,...", options.variants, ao_variant_named,
                   "what is compared (default all)");
    flags.add_list("--motion", "NAME,...", options.motions, motion_named,
                   "still, pan, walk and floor (default all but walk)");
    add_count(flags, "--frames", options.frames, kMaxFrames, "of each motion but floor");
    add_count(flags, "--rounds", options.rounds, kMaxRounds, "number of runs; the best one gives the times");
    add_count(flags, "--reference", options.reference_rays, kMaxReferenceRays, "rays per pixel of the truth");
}

void add_bench_photons_flags(Flags& flags, BenchPhotonsCommand& command) {
    PhotonBenchOptions& options = command.options;
    add_input_flags(flags, command.inputs, "scene files (default scenes/cornell.toml)");
    add_photon_flags(flags, command.photons);
    add_count(flags, "--iterations", command.iterations, kMaxIterations, "of each render");
    flags.add_list("--variant", "NAME,...", options.variants, photon_variant_named,
                   "gather, no-roulette, classic and scatter (default all)");
    add_growth_flag(flags, options.growth);
    add_count(flags, "--rounds", options.rounds, kMaxRounds, "number of runs; the fastest one counts");
    flags.add("--reference", "FILE", command.reference, "picture to measure errors against");
    flags.add_parsed("--box", "X0,Y0,X1,Y1", options.box, parse_pixel_box,
                     "where to measure the error of the blurred picture");
}

}  // namespace voxilux
