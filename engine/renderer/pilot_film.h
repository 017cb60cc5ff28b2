#pragma once

#include <cstdint>

#include "film/film_sums.h"
#include "renderer/prepared_scene.h"
#include "renderer/slices.h"
#include "vk/executor.h"

namespace voxilux {

// A film of samples that no picture is made of: they have random numbers of their own. The device holds the
// world; the film that it holds is overwritten.
class PilotFilm {
  public:
    // `plan` may differ from the prepared one in its effects. Clears the film. Both outlive this.
    PilotFilm(const RenderPlan& plan, const PreparedScene& prepared, const Scene& scene, Executor& executor,
              bool is_cpu);

    // Adds the sample of this number, every number once; returns how long that took, seconds.
    double take(std::uint32_t sample);

    // What the error is estimated from. All samples so far must be those from 0 on.
    [[nodiscard]] FilmSums read();

  private:
    const RenderPlan& plan_;
    gpu::FrameParams params_;
    Executor& executor_;
    SliceGovernor governor_;
    std::uint32_t samples_ = 0;
};

// The seed of a pilot's random numbers, those of no render of this scene.
[[nodiscard]] std::uint32_t pilot_seed(std::uint32_t seed);

}  // namespace voxilux
