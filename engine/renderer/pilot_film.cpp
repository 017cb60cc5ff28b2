#include "renderer/pilot_film.h"

#include <algorithm>
#include <limits>

#include "base/clock.h"
#include "frame/frame.h"
#include "passes/upload.h"
#include "renderer/film_readback.h"
#include "shared/hash.h"

namespace voxilux {
namespace {

constexpr std::uint32_t kPilotStream = 0x70696c74u;  // any number but 0: the seed that users take
constexpr std::uint32_t kNoSample = std::numeric_limits<std::uint32_t>::max();

gpu::FrameParams pilot_params(const RenderPlan& plan, const Scene& scene, const MarchWorld& world) {
    gpu::FrameParams params = frame_params(plan, scene, world);
    params.seed = pilot_seed(params.seed);
    return params;
}

}  // namespace

std::uint32_t pilot_seed(std::uint32_t seed) {
    return gpu::hash4(seed, kPilotStream, 0u, 0u);
}

PilotFilm::PilotFilm(const RenderPlan& plan, const PreparedScene& prepared, const Scene& scene,
                     Executor& executor, bool is_cpu)
    : plan_(plan),
      params_(pilot_params(plan, scene, prepared.march_world)),
      executor_(executor),
      governor_(plan, is_cpu) {
    Recording clear;
    record_film_clear(plan_, clear);
    (void)executor_.run(clear);
}

double PilotFilm::take(std::uint32_t sample) {
    const auto start = std::chrono::steady_clock::now();
    const auto render = [&](const Slice& slice, double& max_ms) {
        Recording recording;
        record_frame(plan_, slice, params_, {.sample = sample, .first = kNoSample}, recording);
        recording.readback("tally");
        for (const PassTime& pass : executor_.run(recording).passes)
            max_ms = std::max(max_ms, pass.max_ms);
        return true;
    };
    (void)governor_.for_each_slice(render);
    ++samples_;
    return seconds_since(start);
}

FilmSums PilotFilm::read() {
    FilmSums film = read_error_film(plan_, executor_);
    std::ranges::fill(film.even, samples_ - samples_ / 2);
    std::ranges::fill(film.odd, samples_ / 2);
    return film;
}

}  // namespace voxilux
