#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "film/film_sums.h"
#include "jobs/render_outcome.h"
#include "plan/render_plan.h"
#include "renderer/film_steps.h"
#include "scene/scene.h"
#include "vk/device.h"
#include "vk/executor.h"

namespace voxilux {

// What a film holds before its first sample: that of a checkpoint, or nothing.
struct FilmStart {
    FilmSums sums;  // no planes: an empty film
    FilmPosition position;
    std::map<std::string, std::uint64_t> work;
    std::map<std::string, std::uint64_t> faults;
};

struct RenderOptions {
    PlanRequest plan;
    DeviceRequest device;
    ExecutorOptions executor;
    std::optional<double> time_limit_s;  // of render_scene; a whole first sample is finished all the same
    std::optional<double> error_target;  // stop when the error estimate is below; relative, 0.01 is 1 %
    const std::atomic<bool>* interrupted = nullptr;
    std::atomic<bool>* checkpoint_wanted = nullptr;  // on_checkpoint is called soon, and this is cleared
    // The film that the frame of this plan goes on from, asked once per frame; a new one when there is none.
    std::function<FilmStart(const Scene&, const RenderPlan&, const DeviceInfo&)> resume;
    // May ask for what is rendered so far, as if the render ended now: that takes memory.
    std::function<void(const Scene&, const std::function<RenderOutcome()>& so_far)> on_checkpoint;
    // With a time limit: gets a strip of the picture and does to it what will be done to the picture at the
    // end, without leaving anything behind. How long that takes is what the limit has to leave room for.
    std::function<void(const Scene&, RenderOutcome strip)> rehearse_end;
    double checkpoint_s = 0.0;  // from one checkpoint to the next; 0: none
    bool keeps_film = false;    // for parts and checkpoints
    // Which files will be written of the picture: memory for that is kept while samples are taken.
    bool writes_exr = false;
    bool writes_png = false;
    // From when times count, those of the report and the time limit: the loading of the scene may be part of
    // it.
    std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
    std::vector<StepTime> steps;  // what came before

    // Whether outcomes have the film.
    [[nodiscard]] bool needs_film() const { return keeps_film || plan.wants_denoised; }
};

struct Progress {
    double done = 0.0;  // [0,1], by whatever is expected to end the render first
    double elapsed_s = 0.0;
    double remaining_s = 0.0;  // at the pace so far
    double remaining_low_s = 0.0, remaining_high_s = 0.0;
    std::uint32_t sample = 0;
    std::optional<double> error;         // what the picture would claim now: the upper end of its interval
    std::optional<double> error_at_end;  // expected
    std::uint32_t frame = 0;             // which of `frames`, from 1; 0 when there is but one picture
    std::uint32_t frames = 0;
};

}  // namespace voxilux
