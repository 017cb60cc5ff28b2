#pragma once

#include <vector>

#include "bench/bench_flags.h"
#include "bench/placed_structure.h"
#include "vk/device.h"

namespace voxilux {

struct MarchBenchOptions {
    std::vector<Traversal> traversals;
    Builder builder = Builder::cpu;
};

// Marches the rays of a scene through each structure on the device and judges a share of the hits. The rounds
// of all rows take turns, so that their ratios hold although the load of the machine changes. A structure
// that the device cannot bind gives rows with a reason. Throws Error(out_of_memory) when the rays do not fit.
[[nodiscard]] std::vector<BenchRow> bench_march(const BenchScene& scene, const MarchBenchOptions& options,
                                                const BenchRequest& request, Device& device);

}  // namespace voxilux
