#include "jobs/effect_price.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "estimators/difference_estimate.h"
#include "scene/facts.h"

namespace voxilux {
namespace {

// A step through all seeds: 2^32 times the golden ratio. It gives the trials other random numbers than a
// render with the settings' own seed.
constexpr std::uint32_t kSeedStep = 0x9E3779B9;

const EffectState& state_of(const RenderPlan& plan, Effect effect) {
    return plan.effects[static_cast<std::size_t>(effect)];
}

PlanRequest switched(const PlanRequest& request, const RenderPlan& plan, Effect effect) {
    PlanRequest other = request;
    other.effects.switches[effect] = plan.has(effect) ? Switch::off : Switch::on;
    return other;
}

// One configuration, and the results of its trials.
struct Entry {
    Effect effect = Effect::voxels;  // the one switched
    PlanRequest request;
    std::optional<double> radius;  // of photons
    std::vector<Image> pictures;
    std::vector<double> ms_per_sample;
};

RenderOutcome render(RenderSession& session, const PriceJob& job, const Entry& entry,
                     const RenderSettings& changed) {
    RenderSettings settings = changed;
    if (entry.radius) settings.photons.radius = entry.radius;
    session.change(settings, entry.request);
    return session.render(job.frame, std::nullopt);
}

// Takes one sample: compiles the shaders, touches the buffers and finds the radius of photons.
RenderPlan warm_up(RenderSession& session, const PriceJob& job, Entry& entry) {
    RenderSettings settings = job.settings;
    settings.spp = 1;
    RenderPlan plan = render(session, job, entry, settings).plan;
    if (plan.needs_pilot()) entry.radius = plan.photons.radius;
    return plan;
}

void take_trial(RenderSession& session, const PriceJob& job, std::size_t trial, Entry& entry) {
    RenderSettings settings = job.settings;
    settings.spp = job.samples;
    settings.seed += static_cast<std::uint32_t>(trial + 1) * kSeedStep;
    RenderOutcome outcome = render(session, job, entry, settings);
    const RenderStatistics& statistics = outcome.statistics;
    entry.ms_per_sample.push_back(sampling_ms(statistics) / std::max(statistics.samples, 1u));
    entry.pictures.push_back(colours_alone(std::move(outcome.image)));
}

void set_times(const Entry& with, const Entry& without, EffectPrice& price) {
    std::vector<double> ms;
    for (std::size_t k = 0; k < with.ms_per_sample.size(); ++k)
        ms.push_back(with.ms_per_sample[k] - without.ms_per_sample[k]);
    std::ranges::sort(ms);
    price.ms_low = ms.front();
    price.ms_high = ms.back();
    price.ms_per_sample = 0.5 * (ms[(ms.size() - 1) / 2] + ms[ms.size() / 2]);
}

void set_error(const Entry& with, const Entry& without, EffectPrice& price) {
    std::vector<DifferenceTrial> trials;
    for (std::size_t k = 0; k < with.pictures.size(); ++k)
        trials.push_back({.test = &without.pictures[k], .base = &with.pictures[k]});
    const SquareEstimate estimate = estimate_difference(trials);
    const auto root = [](double square) { return std::sqrt(std::max(square, 0.0)); };
    price.error = root(estimate.squared);
    price.error_low = root(estimate.low);
    price.error_high = root(estimate.high);
    price.is_beyond_noise = estimate.is_beyond_noise();
}

EffectPrice price_of(const RenderPlan& plan, const Entry& planned, const Entry& other) {
    const EffectState& state = state_of(plan, other.effect);
    EffectPrice price{
        .effect = state.effect, .on = state.on, .reason = state.reason, .by_choice = state.by_choice};
    const Entry& with = state.on ? planned : other;
    const Entry& without = state.on ? other : planned;
    set_times(with, without, price);
    set_error(with, without, price);
    return price;
}

}  // namespace

std::vector<Effect> switchable_effects(const Scene& scene, const RenderPlan& plan,
                                       const PlanRequest& request) {
    const SceneFacts facts = measure_scene(scene);
    std::vector<Effect> effects;
    for (const EffectState& state : plan.effects) {
        const EffectStates other = decide_effects(facts, switched(request, plan, state.effect).effects);
        if (other[static_cast<std::size_t>(state.effect)].on != state.on) effects.push_back(state.effect);
    }
    return effects;
}

std::vector<EffectPrice> price_effects(RenderSession& session, const PriceJob& job) {
    VX_ASSERT(job.samples > 0);
    VX_ASSERT(job.trials >= kMinTrials);
    const auto stops = [&] { return job.stops && job.stops(); };
    std::vector<Entry> entries{{.request = job.request, .radius = job.settings.photons.radius}};
    const RenderPlan plan = warm_up(session, job, entries.front());
    const std::vector<Effect> effects =
        job.effects.empty() ? switchable_effects(session.scene(), plan, job.request) : job.effects;
    for (const Effect effect : effects) {
        if (stops()) return {};
        entries.push_back({.effect = effect,
                           .request = switched(job.request, plan, effect),
                           .radius = entries.front().radius});
        (void)warm_up(session, job, entries.back());
    }
    for (std::size_t trial = 0; trial < job.trials; ++trial) {
        for (Entry& entry : entries) {
            if (stops()) return {};
            take_trial(session, job, trial, entry);
        }
    }
    session.change(job.settings, job.request);
    std::vector<EffectPrice> prices;
    for (const Entry& other : std::span(entries).subspan(1))
        prices.push_back(price_of(plan, entries.front(), other));
    return prices;
}

}  // namespace voxilux
