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

// What a film holds before its first sample: the samples of a checkpoint, or nothing.
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
    std::optional<double> time_limit_s;  // of render_scene; the first sample is always completed
    std::optional<double> error_target;  // stop when the error estimate is below; relative, 0.01 is 1 %
    const std::atomic<bool>* interrupted = nullptr;
    std::atomic<bool>* checkpoint_wanted = nullptr;  // set to have on_checkpoint called soon, which clears it
    // The film that the frame of this plan continues from, asked once per frame; a new one when there is
    // none.
    std::function<FilmStart(const Scene&, const RenderPlan&, const DeviceInfo&)> resume;
    // `so_far` gives the outcome as if the render ended now; that takes memory.
    std::function<void(const Scene&, const std::function<RenderOutcome()>& so_far)> on_checkpoint;
    // With a time limit: gets a strip of the image and does with it what will be done with the image at the
    // end, without leaving files behind. The limit must leave room for the time this takes.
    std::function<void(const Scene&, RenderOutcome strip)> rehearse_end;
    double checkpoint_s = 0.0;  // between checkpoints; 0: none
    bool keeps_film = false;    // for parts and checkpoints
    // Which files will be written: memory for them is reserved while samples are taken.
    bool writes_exr = false;
    bool writes_png = false;
    // Start of the times of the report and of the time limit, so that they can include the loading of the
    // scene.
    std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
    std::vector<StepTime> steps;  // what came before

    // Whether outcomes include the film.
    [[nodiscard]] bool needs_film() const { return keeps_film || plan.wants_denoised; }
};

struct Progress {
    double done = 0.0;  // [0,1], by whatever is expected to end the render first
    double elapsed_s = 0.0;
    double remaining_s = 0.0;  // at the current speed
    double remaining_low_s = 0.0, remaining_high_s = 0.0;
    std::uint32_t sample = 0;
    std::optional<double> error;         // upper end of the interval that the image would have now
    std::optional<double> error_at_end;  // expected
    std::uint32_t frame = 0;  // index of the frame out of `frames`, from 1; 0 when there is only one image
    std::uint32_t frames = 0;
};

}  // namespace voxilux
