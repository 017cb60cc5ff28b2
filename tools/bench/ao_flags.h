#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "jobs/bench/ao_bench.h"

namespace CLI {
class App;
}

namespace voxilux {

// The flags of `bench ao` as typed.
struct BenchAoCommand {
    std::vector<std::string> inputs;
    int extent = 256;
    std::string size = "640x360";
    std::vector<std::string> variants;
    std::vector<std::string> motions;
    int frames = 64;
    int rounds = 2;
    std::uint32_t reference_rays = 4096;
    std::uint32_t seed = 0;
    std::string device;
    std::string json;
};

// Parsing fills `ao`, which must outlive the app.
void add_ao_flags(CLI::App& command, BenchAoCommand& ao);

// Throws Error(usage) for a name that does not exist and a number out of range.
[[nodiscard]] AoBenchOptions ao_options(const BenchAoCommand& command);

// Renders and prints the rows of every scene, as a table each or as JSON. Returns the exit code. Throws
// Error(usage) for a flag that cannot be read, Error(input_refused) for a file.
int run_bench_ao(const BenchAoCommand& command);

}  // namespace voxilux
