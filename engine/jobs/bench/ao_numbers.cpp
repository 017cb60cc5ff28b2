#include "jobs/bench/ao_numbers.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"

namespace voxilux {
namespace {

double ratio(double part, double whole) {
    return whole > 0.0 ? part / whole : 0.0;
}

double as_double(std::uint64_t count) {
    return static_cast<double>(count);
}

}  // namespace

double rmse_over(const AoReference& reference, std::span<const float> visibility) {
    VX_ASSERT_EQ(reference.pixels.size(), reference.visibility.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
        const double difference = static_cast<double>(visibility[reference.pixels[i]]) -
                                  static_cast<double>(reference.visibility[i]);
        sum += difference * difference;
    }
    return std::sqrt(ratio(sum, as_double(reference.pixels.size())));
}

double mean_change(std::span<const float> before, std::span<const float> after,
                   std::span<const std::size_t> pixels) {
    double sum = 0.0;
    for (const std::size_t pixel : pixels)
        sum += std::abs(static_cast<double>(after[pixel]) - static_cast<double>(before[pixel]));
    return ratio(sum, as_double(pixels.size()));
}

double noise_bound(const AoReference& reference, std::uint32_t rays) {
    double sum = 0.0;
    for (const float visibility : reference.visibility)
        sum += static_cast<double>(visibility) * (1.0 - static_cast<double>(visibility));
    return std::sqrt(ratio(sum, as_double(reference.visibility.size()) * rays));
}

void AoWork::add(std::span<const gpu::uint, gpu::kCounterCount> counters) {
    ++frames;
    for (std::size_t i = 0; i < counts.size(); ++i)
        counts[i] += counters[i];
}

double AoWork::mean(std::size_t index) const {
    return ratio(as_double(counts[index]), as_double(frames));
}

double atomics_per_frame(const AoWork& work, std::uint32_t rays_per_sample) {
    const double cell_rays = work.mean(gpu::kWorkAoRays) - work.mean(gpu::kWorkAoOwnRays);
    return work.mean(gpu::kWorkAoSwaps) + 2.0 * cell_rays / rays_per_sample;
}

double searched_percent(const AoWork& work) {
    const double searches = work.mean(gpu::kWorkAoSearches);
    return 100.0 * ratio(searches, searches + work.mean(gpu::kWorkAoReused));
}

double probes_per_search(const AoWork& work) {
    return ratio(work.mean(gpu::kWorkAoProbes), work.mean(gpu::kWorkAoSearches));
}

}  // namespace voxilux
