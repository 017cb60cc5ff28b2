#pragma once

#include <cstdint>

#include "renderer/film_steps.h"
#include "renderer/prepared_scene.h"

namespace voxilux {

// A film of samples with random numbers of their own, from which no image is made. The device must hold the
// world; the film on it is overwritten.
class PilotFilm {
  public:
    // `plan` may differ from the prepared one in its effects.
    PilotFilm(const RenderPlan& plan, const PreparedScene& prepared, const Scene& scene, Executor& executor,
              bool is_cpu);
    PilotFilm(const PilotFilm&) = delete;
    PilotFilm& operator=(const PilotFilm&) = delete;

    // Adds the sample of this number and returns how long that took, seconds. A sample out of order empties
    // the film first.
    double take(std::uint32_t sample);

    // The planes that the error is estimated from.
    [[nodiscard]] FilmSums read() { return steps_.read_for_error(); }

  private:
    RenderPlan plan_;  // of all samples, whichever part is rendered
    gpu::FrameParams params_;
    FilmSteps steps_;
};

// The seed of a pilot's random numbers, which differ from those of the render with `seed`.
[[nodiscard]] std::uint32_t pilot_seed(std::uint32_t seed);

}  // namespace voxilux
