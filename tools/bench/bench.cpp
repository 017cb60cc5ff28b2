#include "bench/bench.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "base/error.h"
#include "jobs/bench/march_bench.h"

namespace voxilux {
namespace {

std::vector<Traversal> traversals_of(const BenchMarchCommand& command) {
    if (command.traversals.empty()) return {all_traversals().begin(), all_traversals().end()};
    std::vector<Traversal> traversals;
    for (const std::string& name : command.traversals) {
        const Traversal traversal = traversal_named(name);
        if (std::ranges::find(traversals, traversal) == traversals.end()) traversals.push_back(traversal);
    }
    return traversals;
}

}  // namespace

void add_march_flags(CLI::App& command, BenchMarchCommand& march) {
    add_bench_flags(command, march.flags);
    add_word_list(command, "--traversal", march.traversals, "structures to march through (default all)")
        ->type_name("NAME,...");
    command.add_option("--device", march.device, "index or part of the name, see voxilux devices")
        ->type_name("NAME");
    command
        .add_option("--build", march.build,
                    "what builds the structures: cpu, device, or both to compare their bits (default cpu)")
        ->type_name("WHO");
}

MarchBenchOptions march_options(const BenchMarchCommand& command) {
    return {.traversals = traversals_of(command), .builder = builder_named(command.build)};
}

CLI::App* add_bench(CLI::App& app, BenchCommand& command) {
    CLI::App* bench = app.add_subcommand("bench", "throughput of one part: march, ao, photons");
    bench->require_subcommand(1);
    CLI::App* march = bench->add_subcommand(
        "march", "rays through each structure of a world, in millions per second of CPU and of wall time");
    add_march_flags(*march, command.march);
    CLI::App* ao = bench->add_subcommand(
        "ao", "ways of finding ambient occlusion: time of each pass, atomics, and error against many rays");
    add_ao_flags(*ao, command.ao);
    CLI::App* photons = bench->add_subcommand(
        "photons",
        "ways of tracing photons: time of each pass, growth with the job, and error against a picture");
    add_photon_bench_flags(*photons, command.photons);
    return bench;
}

int run_bench(const CLI::App& bench, const BenchCommand& command) {
    if (bench.got_subcommand("ao")) return run_bench_ao(command.ao);
    if (bench.got_subcommand("photons")) return run_bench_photons(command.photons);
    return run_bench_march(command.march);
}

int run_bench_march(const BenchMarchCommand& command) {
    const MarchBenchOptions options = march_options(command);
    const BenchRequest request = bench_request(command.flags);
    Device device = open_device({.selector = command.device});
    run_benchmark(command.flags,
                  [&](const BenchScene& scene) { return bench_march(scene, options, request, device); });
    return static_cast<int>(ExitCode::done);
}

}  // namespace voxilux
