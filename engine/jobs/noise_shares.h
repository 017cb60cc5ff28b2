#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "film/film_sums.h"
#include "jobs/next_minute.h"
#include "renderer/prepared_scene.h"
#include "vk/executor.h"

namespace voxilux {

struct ShareJob {
    const PreparedScene& prepared;
    const Scene& scene;
    bool is_cpu = true;
    double sample_s = 0.0;  // time of one sample
    double budget_s = 0.0;  // limit of the time that this may take
    std::function<bool()> stops;
};

// How the squared noise splits by effect: one row for each effect of the plan but AOVs. Renders a few samples
// with each effect off in turn, with the same random numbers as with it on, on a device that holds the world.
// The film is not cleared afterwards.
[[nodiscard]] std::vector<NoiseShare> share_noise(const ShareJob& job, Executor& executor);

// The fraction of an effect in the squared noise of an image, from films of the same number of samples with
// and without it. The fractions of terms that add up to the image add up to 1; one may be below 0, where an
// effect reduces the noise of others. 0 for an image without noise.
[[nodiscard]] double noise_share(const FilmSums& with, const FilmSums& without);

}  // namespace voxilux
