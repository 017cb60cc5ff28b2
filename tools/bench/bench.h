#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace voxilux {

// The flags of `bench march` as typed.
struct BenchMarchCommand {
    std::vector<std::string> inputs;
    std::vector<int> extents;
    std::vector<std::string> traversals;
    std::vector<std::string> rays;
    std::string size = "640x360";
    int rounds = 5;
    std::uint32_t seed = 0;
    std::string device;
    std::string json;
};

// Declares the subcommand `bench` and what it measures; parsing fills `march`, which must outlive the app.
CLI::App* add_bench(CLI::App& app, BenchMarchCommand& march);

// Marches and prints a table per scene, or all rows as JSON. Returns the exit code. Throws Error(usage) for a
// flag that cannot be read, Error(input_refused) for a file.
int run_bench_march(const BenchMarchCommand& command);

}  // namespace voxilux
