#pragma once

// The flags that all benchmarks of rays have, and what they print.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "jobs/bench/bench_row.h"
#include "jobs/bench/bench_scene.h"
#include "jobs/bench/march_bench.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace voxilux {

// As typed.
struct BenchFlags {
    std::vector<std::string> inputs;
    std::vector<int> extents;
    std::vector<std::string> rays;
    std::string size = "640x360";
    int rounds = 5;
    std::uint32_t seed = 0;
    std::string json;
};

// Parsing fills `flags`, which must outlive the app.
void add_bench_flags(CLI::App& command, BenchFlags& flags);

// A flag that takes a list of words: "a,b", repeated, or both.
CLI::Option* add_word_list(CLI::App& command, const std::string& flag, std::vector<std::string>& words,
                           const std::string& help);

// Throws Error(usage) for a flag that cannot be read.
[[nodiscard]] BenchRequest bench_request(const BenchFlags& flags);

// Measures the scenes that the flags name, one at a time, and prints a table for each, or all rows as JSON.
// Throws Error(usage) and Error(input_refused).
void run_benchmark(const BenchFlags& flags,
                   const std::function<std::vector<BenchRow>(const BenchScene&)>& measure);

}  // namespace voxilux
