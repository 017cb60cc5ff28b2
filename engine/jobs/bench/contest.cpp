#include "jobs/bench/contest.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxilux {
namespace {

constexpr double kLeastRunCpuS = 0.1;  // a measured run repeats its rays until it takes this
constexpr double kMostRepeats = 256;

struct Standing {
    const Contestant* contestant = nullptr;
    std::uint32_t repeats = 1;
    Seconds best{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
};

Standing warm_up(const Contestant& contestant) {
    const double once = std::max(contestant.run(1).cpu, 1e-9);
    const double repeats = std::clamp(std::ceil(kLeastRunCpuS / once), 1.0, kMostRepeats);
    return {.contestant = &contestant, .repeats = static_cast<std::uint32_t>(repeats)};
}

BenchRow final_row(const Standing& standing) {
    BenchRow row = standing.contestant->row;
    const double million = static_cast<double>(row.count) * 1e-6;
    row.mrays_per_cpu_s = million / standing.best.cpu;
    row.mrays_per_s = million / standing.best.wall;
    return row;
}

}  // namespace

std::vector<BenchRow> run_contest(const std::vector<Contestant>& contestants, int rounds) {
    std::vector<Standing> standings;
    for (const Contestant& contestant : contestants)
        standings.push_back(contestant.run ? warm_up(contestant) : Standing{.contestant = &contestant});
    for (int round = 0; round < rounds; ++round) {
        for (Standing& standing : standings) {
            if (!standing.contestant->run) continue;
            const Seconds taken = standing.contestant->run(standing.repeats);
            standing.best.cpu = std::min(standing.best.cpu, taken.cpu / standing.repeats);
            standing.best.wall = std::min(standing.best.wall, taken.wall / standing.repeats);
        }
    }
    std::vector<BenchRow> rows;
    for (const Standing& standing : standings)
        rows.push_back(standing.contestant->run ? final_row(standing) : standing.contestant->row);
    return rows;
}

}  // namespace voxilux
