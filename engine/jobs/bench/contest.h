#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "jobs/bench/bench_row.h"
#include "jobs/bench/stopwatch.h"

namespace voxilux {

// A row to be measured. `run` runs its rays `repeats` times and returns what that took; empty when the row
// has a reason or no rays.
struct Contestant {
    BenchRow row;
    std::function<Seconds(std::uint32_t repeats)> run;
};

// Sets the rates of all rows, each from the best of `rounds` runs. The rounds take turns, so that ratios of
// rates hold although the load of the machine changes.
[[nodiscard]] std::vector<BenchRow> run_contest(const std::vector<Contestant>& contestants, int rounds);

}  // namespace voxilux
