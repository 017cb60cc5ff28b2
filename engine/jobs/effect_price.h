#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "jobs/render_session.h"
#include "plan/render_plan.h"

namespace voxilux {

// What one effect of a scene costs and brings: that of switching it off, or of forcing it on where the plan
// left it out.
struct EffectPrice {
    Effect effect = Effect::voxels;
    bool on = false;             // as planned
    std::string reason;          // of the plan
    bool by_choice = false;      // off although the picture would be another one with it
    double ms_per_sample = 0.0;  // on the device, with the effect less without it: the median of the trials
    double ms_low = 0.0;         // least and most of the trials
    double ms_high = 0.0;
    double error = 0.0;      // of the picture without the effect: sqrt(relMSE) against that with it
    double error_low = 0.0;  // interval of 95 %
    double error_high = 0.0;
    bool is_beyond_noise = false;
};

// What is priced, and how carefully.
struct PriceJob {
    std::int64_t frame = 0;
    RenderSettings settings;
    PlanRequest request;
    std::uint32_t samples = 4;    // of each picture
    std::size_t trials = 3;       // at least kMinTrials (film/difference_estimate.h); each has its own seed
    std::vector<Effect> effects;  // none: all that can be switched
    std::function<bool()> stops;  // asked before each picture
};

// The effects of a plan that can be switched: to off, or to on where that changes the plan. In their order.
[[nodiscard]] std::vector<Effect> switchable_effects(const Scene& scene, const RenderPlan& plan,
                                                     const PlanRequest& request);

// The prices of a job's effects, by pictures as planned and pictures with one effect switched: both of one
// trial have the same random numbers and the same first radius of photons, and the trials take turns.
// `session` is one of the scene, which renders the job's settings afterwards. Empty when `stops` said so.
[[nodiscard]] std::vector<EffectPrice> price_effects(RenderSession& session, const PriceJob& job);

}  // namespace voxilux
