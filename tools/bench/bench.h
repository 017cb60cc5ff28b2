#pragma once

#include "bench/ao_flags.h"
#include "bench/photon_flags.h"
#include "jobs/bench/march_bench.h"

namespace voxilux {

// The flags of `bench march` as typed.
struct BenchMarchCommand {
    BenchFlags flags;
    std::vector<std::string> traversals;
    std::string device;
    std::string build = "cpu";
};

// Parsing fills `march`, which must outlive the app.
void add_march_flags(CLI::App& command, BenchMarchCommand& march);

// Throws Error(usage) for a name that does not exist.
[[nodiscard]] MarchBenchOptions march_options(const BenchMarchCommand& command);

// The flags of all that `bench` measures.
struct BenchCommand {
    BenchMarchCommand march;
    BenchAoCommand ao;
    BenchPhotonsCommand photons;
};

// Declares the subcommand `bench` and what it measures; parsing fills `command`, which must outlive the app.
CLI::App* add_bench(CLI::App& app, BenchCommand& command);

// Runs what was asked for of a parsed `bench`. Returns the exit code; throws as the parts do.
int run_bench(const CLI::App& bench, const BenchCommand& command);

// Marches and prints what run_benchmark says. Returns the exit code. Throws Error(usage) for a flag that
// cannot be read, Error(input_refused) for a file.
int run_bench_march(const BenchMarchCommand& command);

}  // namespace voxilux
