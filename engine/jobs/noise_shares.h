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
    double sample_s = 0.0;  // what a sample takes
    double budget_s = 0.0;  // most that this may take
    std::function<bool()> stops;
};

// How the squared noise splits by effect: one row for each effect of the plan but AOVs. Renders a few samples
// with each effect off in turn, with the random numbers of the same samples with it on, on a device that
// holds the world. The film is left dirty.
[[nodiscard]] std::vector<NoiseShare> share_noise(const ShareJob& job, Executor& executor);

// The share of an effect in the squared noise of a picture, from films of equal samples with it and without
// it. The shares of terms that add up to the picture add up to 1; one may be below 0, where an effect makes
// the noise of others smaller. 0 for a picture without noise.
[[nodiscard]] double noise_share(const FilmSums& with, const FilmSums& without);

}  // namespace voxilux
