#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "flags.h"
#include "jobs/bench/ao_bench.h"
#include "jobs/bench/march_bench.h"
#include "jobs/bench/photon_bench.h"
#include "scene_options.h"

namespace voxilux {

// Options of all benchmarks.
struct BenchInputs {
    std::vector<std::string> files;  // none: the benchmark's own world or scene
    glm::ivec2 size{640, 360};
    std::uint32_t seed = 0;
    std::string device;
    std::string json;
};

struct BenchMarchCommand {
    BenchInputs inputs;
    std::vector<int> extents;  // edges of procedural worlds; without these and files: 256 and 512
    MarchBenchOptions options;
};

struct BenchAoCommand {
    BenchInputs inputs;
    int extent = 256;  // edge of the procedural world, used where there are no files
    AoBenchOptions options;
};

struct BenchPhotonsCommand {
    BenchInputs inputs{.size = {256, 256}};
    SettingsChanges photons;
    int iterations = 64;
    std::string reference;  // picture to measure errors against
    PhotonBenchOptions options;
};

void add_bench_march_flags(Flags& flags, BenchMarchCommand& command);
void add_bench_ao_flags(Flags& flags, BenchAoCommand& command);
void add_bench_photons_flags(Flags& flags, BenchPhotonsCommand& command);

// They measure and print the rows of every scene, as tables or as JSON. They return the exit code and throw
// Error(input_refused) for a file.
[[nodiscard]] int run_bench_march(const BenchMarchCommand& command);
[[nodiscard]] int run_bench_ao(const BenchAoCommand& command);
[[nodiscard]] int run_bench_photons(const BenchPhotonsCommand& command);

// Prints what `measure` says of the scenes of `bench march`, one at a time.
void bench_march_scenes(const BenchMarchCommand& command,
                        const std::function<std::vector<BenchRow>(const BenchScene&)>& measure);

}  // namespace voxilux
