#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "jobs/bench/photon_bench.h"
#include "photon_options.h"

namespace CLI {
class App;
}

namespace voxilux {

// The flags of `bench photons` as typed.
struct BenchPhotonsCommand {
    std::vector<std::string> inputs;
    std::string size = "256x256";
    PhotonOptions photons{.count = 65536, .radius = "2"};
    int iterations = 64;
    std::vector<std::string> variants;
    std::vector<std::string> growth;
    int rounds = 2;
    std::uint32_t seed = 0;
    std::string device;
    std::string reference;
    std::string box;
    std::string json;
};

// Parsing fills `photons`, which must outlive the app.
void add_photon_bench_flags(CLI::App& command, BenchPhotonsCommand& photons);

// Throws Error(usage) for a name that does not exist and a number out of range, Error(input_refused) for the
// reference.
[[nodiscard]] PhotonBenchOptions photon_bench_options(const BenchPhotonsCommand& command);

// Renders and prints the rows of every scene, as a table for each series or as JSON: {rows, growth}. Returns
// the exit code. Throws as photon_bench_options and load_scene.
int run_bench_photons(const BenchPhotonsCommand& command);

}  // namespace voxilux
