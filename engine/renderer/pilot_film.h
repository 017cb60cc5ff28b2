#pragma once

#include <cstdint>

#include "renderer/film_steps.h"
#include "renderer/prepared_scene.h"

namespace voxilux {

// A film of samples that no image is made of: they have random numbers of their own. The device holds the
// world; the film that it holds is overwritten.
class PilotFilm {
  public:
    // `plan` may differ from the prepared one in its effects.
    PilotFilm(const RenderPlan& plan, const PreparedScene& prepared, const Scene& scene, Executor& executor,
              bool is_cpu);
    PilotFilm(const PilotFilm&) = delete;
    PilotFilm& operator=(const PilotFilm&) = delete;

    // Adds the sample of this number; returns how long that took, seconds. Out of order it empties the film.
    double take(std::uint32_t sample);

    // What the error is estimated from.
    [[nodiscard]] FilmSums read() { return steps_.read_for_error(); }

  private:
    RenderPlan plan_;  // of all samples, whichever part is rendered
    gpu::FrameParams params_;
    FilmSteps steps_;
};

// The seed of a pilot's random numbers, those of no render of this scene.
[[nodiscard]] std::uint32_t pilot_seed(std::uint32_t seed);

}  // namespace voxilux
