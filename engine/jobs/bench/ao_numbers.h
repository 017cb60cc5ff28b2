#pragma once

// The measures that `bench ao` takes of frames.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/counters.h"

namespace voxilux {

// Visibility in [0,1] of some pixels of an image, from many rays.
struct AoReference {
    std::vector<std::size_t> pixels;  // indices in the image, row by row
    std::vector<float> visibility;    // of these pixels
};

// RMS difference over the reference's pixels; 0 when it has none. `visibility` covers the whole image.
[[nodiscard]] double rmse_over(const AoReference& reference, std::span<const float> visibility);

// Mean absolute difference of two images over some pixels; 0 when there are none.
[[nodiscard]] double mean_change(std::span<const float> before, std::span<const float> after,
                                 std::span<const std::size_t> pixels);

// RMS noise of the reference itself when its `rays` are independent. Rays that follow a low-discrepancy
// sequence have less.
[[nodiscard]] double noise_bound(const AoReference& reference, std::uint32_t rays);

// Sums of counters (shared/counters.h) over some frames.
struct AoWork {
    std::uint64_t frames = 0;
    std::array<std::uint64_t, gpu::kCounterCount> counts{};

    void add(std::span<const gpu::uint, gpu::kCounterCount> counters);
    // Mean of a count over the frames; 0 without any.
    [[nodiscard]] double mean(std::size_t index) const;
};

// Atomic operations on the table in a frame: one for each compare-and-swap of a key, and for each hit that
// adds samples to its cell one for their number and one for the unoccluded ones.
[[nodiscard]] double atomics_per_frame(const AoWork& work, std::uint32_t rays_per_sample);

// Percentage of hits whose cells were searched in the table; 0 without hits.
[[nodiscard]] double searched_percent(const AoWork& work);

// Keys compared per search; 0 without searches.
[[nodiscard]] double probes_per_search(const AoWork& work);

}  // namespace voxilux
