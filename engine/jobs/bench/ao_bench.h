#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "jobs/bench/ao_stage.h"

namespace voxilux {

struct AoBenchOptions {
    std::vector<AoVariant> variants = ao_variants();
    std::vector<Motion> motions{Motion::still, Motion::pan, Motion::floor};
    int frames = 64;
    int rounds = 2;  // the times are those of the fastest
    std::uint32_t reference_rays = 4096;
};

// Rays per pixel in the frames of Motion::floor: enough to bring the noise of a cell below its bias.
inline constexpr std::uint32_t kFloorRays = 64;
inline constexpr int kFloorFrames = 16;

// A row for each motion and variant; variants take turns. Counts are means over all frames but the first.
// Times are medians over the second half of the frames, from the fastest round.
[[nodiscard]] std::vector<AoRow> bench_ao(const std::string& name, AoStage& stage,
                                          const AoBenchOptions& options);

}  // namespace voxilux
