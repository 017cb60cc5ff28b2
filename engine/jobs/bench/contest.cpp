#include "jobs/bench/contest.h"

#include <algorithm>
#include <cmath>

namespace voxilux {
namespace {

constexpr double kMinTurnCpuS = 0.1;  // a turn repeats its rays until it has taken this long
constexpr double kMaxRepeats = 256;

}  // namespace

void MarchContestant::warm_up() {
    if (!run) return;
    const double once = std::max(run(1).cpu, 1e-9);
    repeats = static_cast<std::uint32_t>(std::clamp(std::ceil(kMinTurnCpuS / once), 1.0, kMaxRepeats));
}

void MarchContestant::take_turn() {
    if (!run) return;
    const Seconds taken = run(repeats);
    const double million = static_cast<double>(row.count) * 1e-6 * repeats;
    rates.push_back(million / taken.cpu);
    row.mrays_per_cpu_s = std::max(row.mrays_per_cpu_s, rates.back());
    row.mrays_per_s = std::max(row.mrays_per_s, million / taken.wall);
}

}  // namespace voxilux
