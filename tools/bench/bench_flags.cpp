#include "bench/bench_flags.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "base/error.h"
#include "output_files.h"
#include "parse_values.h"

namespace voxilux {
namespace {

constexpr int kMostRounds = 1000;

std::vector<int> extents_of(const BenchFlags& flags) {
    if (flags.extents.empty() && flags.inputs.empty()) return {256, 512};
    for (const int extent : flags.extents) {
        if (extent < kLeastExtent || extent > kMostExtent || extent % 16 != 0) {
            throw Error(ExitCode::usage, fmt::format("--extent: {} is not a multiple of 16 from {} to {}",
                                                     extent, kLeastExtent, kMostExtent));
        }
    }
    return flags.extents;
}

}  // namespace

void add_bench_flags(CLI::App& command, BenchFlags& flags) {
    command.add_option("INPUT", flags.inputs, ".vox and scene files (default: procedural worlds)")
        ->take_all()
        ->type_name("");
    command.add_option("--extent", flags.extents, "edges of procedural worlds, in voxels (default 256,512)")
        ->delimiter(',')
        ->take_all()
        ->allow_extra_args(false)
        ->type_name("N,...");
    add_word_list(command, "--rays", flags.rays, "primary, ao and long (default all)")->type_name("KIND,...");
    command.add_option("--size", flags.size, "picture size in pixels (default 640x360)")->type_name("WxH");
    command.add_option("--rounds", flags.rounds, "runs of which the best counts (default 5)")->type_name("N");
    command.add_option("--seed", flags.seed, "seed of worlds and rays (default 0)")->type_name("N");
    command.add_option("--json", flags.json, "write the rows as JSON; - is standard output")
        ->type_name("FILE");
}

CLI::Option* add_word_list(CLI::App& command, const std::string& flag, std::vector<std::string>& words,
                           const std::string& help) {
    return command.add_option(flag, words, help)->delimiter(',')->take_all()->allow_extra_args(false);
}

BenchRequest bench_request(const BenchFlags& flags) {
    if (flags.rounds < 1 || flags.rounds > kMostRounds)
        throw Error(ExitCode::usage,
                    fmt::format("--rounds: {} is not from 1 to {}", flags.rounds, kMostRounds));
    BenchRequest request{
        .size = parse_size("--size", flags.size), .rounds = flags.rounds, .seed = flags.seed};
    for (const std::string& name : flags.rays) {
        const RayKind kind = ray_kind_named(name);
        if (std::ranges::find(request.kinds, kind) == request.kinds.end()) request.kinds.push_back(kind);
    }
    if (request.kinds.empty()) request.kinds.assign(kRayKinds.begin(), kRayKinds.end());
    return request;
}

void run_benchmark(const BenchFlags& flags,
                   const std::function<std::vector<BenchRow>(const BenchScene&)>& measure) {
    const std::vector<int> extents = extents_of(flags);
    const glm::ivec2 size = parse_size("--size", flags.size);
    check_writable(flags.json);
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    const auto run = [&](const BenchScene& scene) {
        const std::vector<BenchRow> rows = measure(scene);
        for (const BenchRow& row : rows)
            json.push_back(to_json(row));
        if (flags.json == "-") return;
        fmt::print("{}\n", describe(rows));
        std::fflush(stdout);
    };
    for (const int extent : extents)
        run(procedural_scene(extent, flags.seed));
    for (const std::string& input : flags.inputs)
        run(file_scene(input, size));
    write_json(flags.json, json);
}

}  // namespace voxilux
