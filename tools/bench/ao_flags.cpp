#include "bench/ao_flags.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "base/error.h"
#include "bench/bench_flags.h"
#include "jobs/bench/bench_scene.h"
#include "output_files.h"
#include "parse_values.h"

namespace voxilux {
namespace {

constexpr int kMostFrames = 4096;
constexpr int kMostRounds = 1000;
constexpr std::int64_t kMostReferenceRays = 65535;  // most that a pixel takes for one sample

void check_range(const char* flag, std::int64_t value, std::int64_t most) {
    if (value < 1 || value > most)
        throw Error(ExitCode::usage, fmt::format("{}: {} is not from 1 to {}", flag, value, most));
}

std::vector<Motion> motions_of(const std::vector<std::string>& names) {
    if (names.empty()) return {Motion::still, Motion::pan, Motion::floor};
    std::vector<Motion> motions;
    for (const std::string& name : names) {
        const Motion motion = motion_named(name);
        if (std::ranges::find(motions, motion) == motions.end()) motions.push_back(motion);
    }
    return motions;
}

}  // namespace

void add_ao_flags(CLI::App& command, BenchAoCommand& ao) {
    command.add_option("INPUT", ao.inputs, ".vox and scene files (default: a procedural world)")
        ->take_all()
        ->type_name("");
    command.add_option("--extent", ao.extent, "edge of the procedural world, in voxels (default 256)")
        ->type_name("N");
    command.add_option("--size", ao.size, "picture size in pixels (default 640x360)")->type_name("WxH");
    add_word_list(command, "--variant", ao.variants, "what is compared (default all)")->type_name("NAME,...");
    add_word_list(command, "--motion", ao.motions, "still, pan, walk and floor (default all but walk)")
        ->type_name("NAME,...");
    command.add_option("--frames", ao.frames, "of each motion but floor (default 64)")->type_name("N");
    command.add_option("--rounds", ao.rounds, "runs of which the best gives the times (default 2)")
        ->type_name("N");
    command.add_option("--reference", ao.reference_rays, "rays per pixel of the truth (default 4096)")
        ->type_name("N");
    command.add_option("--seed", ao.seed, "seed of the world and the rays (default 0)")->type_name("N");
    command.add_option("--device", ao.device, "index or part of the name, see voxilux devices")
        ->type_name("NAME");
    command.add_option("--json", ao.json, "write the rows as JSON; - is standard output")->type_name("FILE");
}

AoBenchOptions ao_options(const BenchAoCommand& command) {
    check_range("--frames", command.frames, kMostFrames);
    check_range("--rounds", command.rounds, kMostRounds);
    check_range("--reference", command.reference_rays, kMostReferenceRays);
    if (command.extent < kLeastExtent || command.extent > kMostExtent || command.extent % 16 != 0) {
        throw Error(ExitCode::usage, fmt::format("--extent: {} is not a multiple of 16 from {} to {}",
                                                 command.extent, kLeastExtent, kMostExtent));
    }
    return {.variants = ao_variants_named(command.variants),
            .motions = motions_of(command.motions),
            .frames = command.frames,
            .rounds = command.rounds,
            .reference_rays = command.reference_rays};
}

int run_bench_ao(const BenchAoCommand& command) {
    const AoBenchOptions options = ao_options(command);
    const glm::ivec2 size = parse_size("--size", command.size);
    check_writable(command.json);
    Device device = open_device({.selector = command.device});
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    const auto run = [&](const std::string& name, Scene scene) {
        scene.settings.seed = command.seed;
        AoStage stage(std::move(scene), device);
        const std::vector<AoRow> rows = bench_ao(name, stage, options);
        for (const AoRow& row : rows)
            json.push_back(to_json(row));
        if (command.json == "-") return;
        fmt::print("{}\n", describe(rows));
        std::fflush(stdout);
    };
    if (command.inputs.empty()) run("procedural", ao_procedural_scene(command.extent, command.seed, size));
    for (const std::string& input : command.inputs)
        run(std::filesystem::path(input).filename().string(), ao_file_scene(input, size));
    write_json(command.json, json);
    return static_cast<int>(ExitCode::done);
}

}  // namespace voxilux
