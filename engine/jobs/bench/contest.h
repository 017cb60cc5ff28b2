#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/stopwatch.h"
#include "jobs/bench/bench_row.h"

namespace voxilux {

// Warms all contestants up, then gives each its turn, `rounds` times: taking turns keeps ratios of times
// valid while the load of the machine changes. A contestant keeps the best of its turns.
template <class Contestant>
void run_contest(std::vector<Contestant>& contestants, int rounds) {
    for (Contestant& contestant : contestants)
        contestant.warm_up();
    for (int round = 0; round < rounds; ++round)
        for (Contestant& contestant : contestants)
            contestant.take_turn();
}

// The rows of contestants, in the same order.
template <class Contestant>
[[nodiscard]] auto rows_of(const std::vector<Contestant>& contestants) {
    std::vector<decltype(Contestant::row)> rows;
    for (const Contestant& contestant : contestants)
        rows.push_back(contestant.row);
    return rows;
}

// Rays through a structure, with the best rates so far. `run` runs them `repeats` times and returns the time
// that took; it is empty when the row has a reason or no rays.
struct MarchContestant {
    BenchRow row;
    std::function<Seconds(std::uint32_t repeats)> run;
    std::uint32_t repeats = 1;  // per turn, because one run is too short to be timed
    std::vector<double> rates;  // millions of rays per CPU second of each turn so far

    void warm_up();
    void take_turn();
};

}  // namespace voxilux
