#pragma once

#include <span>
#include <string>

#include "jobs/bench/contest.h"

namespace voxilux {

// For each structure its rates per CPU second over those of Embree's fastest query for the same rays, and
// over those of kBaseline, with geometric means over the kinds of rays. A ratio is the median over the turns,
// of rates that were measured one after the other: it holds on a busy machine.
[[nodiscard]] std::string describe_ratios(std::span<const MarchContestant> contestants);

}  // namespace voxilux
