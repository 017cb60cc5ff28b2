#include "bench/bench.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "base/error.h"
#include "bench/march_bench.h"
#include "output_files.h"
#include "parse_values.h"

namespace voxilux {
namespace {

constexpr int kMostRounds = 1000;

std::vector<int> extents_of(const BenchMarchCommand& command) {
    if (command.extents.empty() && command.inputs.empty()) return {256, 512};
    for (const int extent : command.extents) {
        if (extent < kLeastExtent || extent > kMostExtent || extent % 16 != 0) {
            throw Error(ExitCode::usage, fmt::format("--extent: {} is not a multiple of 16 from {} to {}",
                                                     extent, kLeastExtent, kMostExtent));
        }
    }
    return command.extents;
}

template <class T, class Parse>
std::vector<T> parse_all(const std::vector<std::string>& names, std::span<const T> all, const Parse& parse) {
    if (names.empty()) return {all.begin(), all.end()};
    std::vector<T> parsed;
    for (const std::string& name : names) {
        const T value = parse(name);
        if (std::ranges::find(parsed, value) == parsed.end()) parsed.push_back(value);
    }
    return parsed;
}

MarchBenchOptions options_of(const BenchMarchCommand& command) {
    if (command.rounds < 1 || command.rounds > kMostRounds)
        throw Error(ExitCode::usage,
                    fmt::format("--rounds: {} is not from 1 to {}", command.rounds, kMostRounds));
    return {.traversals = parse_all<Traversal>(command.traversals, all_traversals(), traversal_named),
            .kinds = parse_all<RayKind>(command.rays, kRayKinds, ray_kind_named),
            .size = parse_size("--size", command.size),
            .rounds = command.rounds,
            .seed = command.seed};
}

// A list of values: "a,b", repeated, or both.
template <class T>
CLI::Option* add_list(CLI::App& app, const char* flag, std::vector<T>& values, const char* help) {
    return app.add_option(flag, values, help)->delimiter(',')->take_all()->allow_extra_args(false);
}

}  // namespace

CLI::App* add_bench(CLI::App& app, BenchMarchCommand& march) {
    CLI::App* bench = app.add_subcommand("bench", "throughput of one part: march");
    bench->require_subcommand(1);
    CLI::App* command = bench->add_subcommand(
        "march", "rays through each structure of a world, in millions per second of CPU and of wall time");
    command->add_option("INPUT", march.inputs, ".vox and scene files (default: procedural worlds)")
        ->take_all()
        ->type_name("");
    add_list(*command, "--extent", march.extents, "edges of procedural worlds, in voxels (default 256,512)")
        ->type_name("N,...");
    add_list(*command, "--traversal", march.traversals, "structures to march through (default all)")
        ->type_name("NAME,...");
    add_list(*command, "--rays", march.rays, "primary, ao and long (default all)")->type_name("KIND,...");
    command->add_option("--size", march.size, "picture size in pixels (default 640x360)")->type_name("WxH");
    command->add_option("--rounds", march.rounds, "runs of which the best counts (default 5)")
        ->type_name("N");
    command->add_option("--seed", march.seed, "seed of worlds and rays (default 0)")->type_name("N");
    command->add_option("--device", march.device, "index or part of the name, see voxilux devices")
        ->type_name("NAME");
    command->add_option("--json", march.json, "write the rows as JSON; - is standard output")
        ->type_name("FILE");
    return bench;
}

int run_bench_march(const BenchMarchCommand& command) {
    const MarchBenchOptions options = options_of(command);
    const std::vector<int> extents = extents_of(command);
    check_writable(command.json);
    Device device = open_device({.selector = command.device});
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    const auto bench = [&](const BenchScene& scene) {
        const std::vector<BenchRow> rows = bench_march(scene, options, device);
        for (const BenchRow& row : rows)
            json.push_back(to_json(row));
        if (command.json == "-") return;
        fmt::print("{}\n", describe(rows));
        std::fflush(stdout);
    };
    for (const int extent : extents)
        bench(procedural_scene(extent, command.seed));
    for (const std::string& input : command.inputs)
        bench(file_scene(input, options.size));
    write_json(command.json, json);
    return static_cast<int>(ExitCode::done);
}

}  // namespace voxilux
