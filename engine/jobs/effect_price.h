#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "jobs/render_session.h"
#include "plan/render_plan.h"

namespace voxilux {

// What one effect of a scene costs and contributes, from switching it off, or forcing it on where the plan
// left it out.
struct EffectPrice {
    Effect effect = Effect::voxels;
    bool on = false;             // in the plan
    std::string reason;          // from the plan
    bool by_choice = false;      // off although it would change the image
    double ms_per_sample = 0.0;  // device time with the effect minus without: the median of the trials
    double ms_low = 0.0;         // smallest and largest of the trials
    double ms_high = 0.0;
    double error = 0.0;      // of the image without the effect: sqrt(relMSE) against the image with it
    double error_low = 0.0;  // 95 % interval
    double error_high = 0.0;
    bool is_beyond_noise = false;
};

// What to price, and how carefully.
struct PriceJob {
    std::int64_t frame = 0;
    RenderSettings settings;
    PlanRequest request;
    std::uint32_t samples = 4;    // of each image
    std::size_t trials = 3;       // at least kMinTrials (film/difference_estimate.h); each has its own seed
    std::vector<Effect> effects;  // empty: all that can be switched
    std::function<bool()> stops;  // asked before each image
};

// The effects of a plan that can be switched off, or on where that changes the plan, in the order of Effect.
[[nodiscard]] std::vector<Effect> switchable_effects(const Scene& scene, const RenderPlan& plan,
                                                     const PlanRequest& request);

// The prices of a job's effects, from images as planned and images with one effect switched. Both of one
// trial have the same random numbers and the same first radius of photons; trials alternate between
// configurations. `session` must be one of the scene; afterwards it renders the job's settings. Empty when
// `stops` returned true.
[[nodiscard]] std::vector<EffectPrice> price_effects(RenderSession& session, const PriceJob& job);

}  // namespace voxilux
