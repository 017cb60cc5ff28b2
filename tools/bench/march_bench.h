#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "bench/bench_rays.h"
#include "bench/bench_row.h"
#include "bench/bench_scene.h"
#include "vk/device.h"

namespace voxilux {

struct MarchBenchOptions {
    std::vector<Traversal> traversals;
    std::vector<RayKind> kinds;
    glm::ivec2 size{640, 360};  // pixels
    int rounds = 5;             // each row takes the best of them
    std::uint32_t seed = 0;
};

// Marches the rays of a scene through each structure on the device and judges a share of the hits. The rounds
// of all rows take turns, so that their ratios hold although the load of the machine changes. A structure
// that the device cannot bind gives rows with a reason. Throws Error(out_of_memory) when the rays do not fit.
[[nodiscard]] std::vector<BenchRow> bench_march(const BenchScene& scene, const MarchBenchOptions& options,
                                                Device& device);

}  // namespace voxilux
