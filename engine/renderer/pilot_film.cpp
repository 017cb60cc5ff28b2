#include "renderer/pilot_film.h"

#include "base/clock.h"
#include "frame/frame.h"
#include "passes/sky/sky.h"
#include "shared/hash.h"

namespace voxilux {
namespace {

constexpr std::uint32_t kPilotStream = 0x70696c74u;  // any number; keeps the pilot's random numbers apart

gpu::FrameParams pilot_params(const RenderPlan& plan, const Scene& scene, const MarchWorld& world) {
    gpu::FrameParams params = frame_params(plan, scene, world);
    params.seed = pilot_seed(params.seed);
    return params;
}

RenderPlan without_part(RenderPlan plan) {
    plan.part = {};
    return plan;
}

}  // namespace

std::uint32_t pilot_seed(std::uint32_t seed) {
    return gpu::hash4(seed, kPilotStream, 0u, 0u);
}

PilotFilm::PilotFilm(const RenderPlan& plan, const PreparedScene& prepared, const Scene& scene,
                     Executor& executor, bool is_cpu)
    : plan_(without_part(plan)),
      params_(pilot_params(plan, scene, prepared.march_world)),
      steps_(plan_, executor, is_cpu) {
    // A variant without occlusion may need other tables of the sky than those that were prepared.
    if (traces_sky(plan_) != traces_sky(prepared.plan)) {
        Recording sky;
        record_sky_build(plan_, scene, sky);
        executor.run(sky);
    }
    steps_.start_frame(params_);
}

double PilotFilm::take(std::uint32_t sample) {
    const auto start = std::chrono::steady_clock::now();
    if (sample != steps_.position().samples) steps_.start_frame(params_, {.samples = sample});
    while (steps_.step_tile().samples == 0) {
    }
    return seconds_since(start);
}

}  // namespace voxilux
