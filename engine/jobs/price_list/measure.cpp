#include "jobs/price_list/measure.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "base/median.h"
#include "world/march_world.h"

namespace voxilux {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kNothingMeasured =
    "interrupted before anything could be compared; no price list was written";

// Steps through all seeds: 2^32 times the golden ratio, and times its square.
constexpr std::uint32_t kRepeatStep = 0x9E3779B9;
constexpr std::uint32_t kLevelStep = 0x61C88647;
// Fraction of the budget that one configuration may take before it gets fewer samples.
constexpr double kMaxShare = 0.12;

std::uint32_t seed_of(const Workshop& workshop, std::size_t repeat, std::uint32_t samples) {
    return workshop.seed + static_cast<std::uint32_t>(repeat + 1) * kRepeatStep + (samples + 7) * kLevelStep;
}

void warm_up(const Workshop& workshop, MeasuredConfiguration& configuration) {
    const MeasureJob job{
        .configuration = configuration.configuration, .frame = workshop.frame, .seed = workshop.seed};
    const RenderOutcome first = measure_once(*configuration.session, job).outcome;
    configuration.load_s = first.statistics.load_s;
    const Measured second = measure_once(*configuration.session, job);
    const Measured third = measure_once(*configuration.session, job);
    configuration.plan = second.outcome.plan;
    configuration.per_sample_s = std::max(std::min(second.time_s, third.time_s), 1e-6);
}

void prepare_configuration(const Workshop& workshop, RenderSession& session,
                           MeasuredConfiguration& configuration) {
    try {
        if (configuration.configuration.traversal) {
            RenderOptions options = workshop.options;
            options.plan = configuration.configuration.request;
            options.plan.traversal = configuration.configuration.traversal;
            options.started = std::chrono::steady_clock::now();
            configuration.own = std::make_unique<RenderSession>(workshop.scene, options);
        }
        configuration.session = configuration.own ? configuration.own.get() : &session;
        warm_up(workshop, configuration);
    } catch (const Error& error) {
        if (error.code() != ExitCode::input_refused && error.code() != ExitCode::out_of_memory) throw;
        configuration.refusal = error.what();
        configuration.own.reset();
        configuration.session = nullptr;
    }
}

// A sixteenth, a quarter and all.
std::vector<std::uint32_t> three_levels(std::uint32_t top) {
    std::set<std::uint32_t> levels;
    for (const std::uint32_t divisor : {16u, 4u, 1u})
        if (top / divisor > 0) levels.insert(top / divisor);
    return {levels.begin(), levels.end()};
}

std::vector<std::uint32_t> all_levels(std::uint32_t top) {
    std::set<std::uint32_t> levels{top};
    for (std::uint32_t power = 1; power < top; power *= 2)
        levels.insert(power);
    for (const std::uint32_t level : three_levels(top))
        levels.insert(level);
    return {levels.begin(), levels.end()};
}

double cost_of(const std::vector<std::uint32_t>& levels, double per_sample_s) {
    double samples = 0.0;
    for (const std::uint32_t level : levels)
        samples += level;
    return samples * per_sample_s;
}

// The levels of a configuration that take at most `max_s`.
std::vector<std::uint32_t> levels_within(std::uint32_t top, double per_sample_s, double max_s) {
    while (top > 1 && cost_of(three_levels(top), per_sample_s) > max_s)
        top = std::max(top / 4, 1u);
    return three_levels(top);
}

struct Round {
    MeasuredConfiguration* configuration = nullptr;
    std::vector<Image> pictures;
    Level level;
};

void measure_round(const Workshop& workshop, std::vector<Round>& rounds, std::uint32_t samples) {
    for (std::size_t repeat = 0; repeat < workshop.repeats; ++repeat) {
        for (Round& round : rounds) {
            Measured measured = measure_once(*round.configuration->session,
                                             {.configuration = round.configuration->configuration,
                                              .frame = workshop.frame,
                                              .seed = seed_of(workshop, repeat, samples),
                                              .samples = samples});
            round.level.times_s.push_back(measured.time_s);
            if (repeat == 0) round.level.claimed = measured.outcome.statistics.error;
            round.pictures.push_back(colours_alone(std::move(measured.outcome.image)));
        }
    }
}

void finish_round(const Workshop& workshop, std::vector<Round>& rounds, std::uint32_t samples) {
    const Round& base = rounds.front();
    for (Round& round : rounds) {
        round.level.samples = samples;
        round.level.error = split_error(round.pictures, *workshop.reference, workshop.noise);
        if (!round.configuration->other_pixels)
            round.configuration->other_pixels =
                differing_pixels(round.pictures.front(), base.pictures.front());
    }
    for (Round& round : rounds) {
        round.level.picture = std::move(round.pictures.front());
        // The image of configuration 0 is kept at every level, those of the others only at the last.
        if (&round != &rounds.front() && !round.configuration->levels.empty())
            round.configuration->levels.back().picture = {};
        round.configuration->levels.push_back(std::move(round.level));
    }
}

void measure_level(const Workshop& workshop, const std::vector<MeasuredConfiguration*>& configurations,
                   std::uint32_t samples) {
    std::vector<Round> rounds;
    for (MeasuredConfiguration* const configuration : configurations)
        rounds.push_back({.configuration = configuration});
    measure_round(workshop, rounds, samples);
    finish_round(workshop, rounds, samples);
}

// The configurations that have reached `samples`, and the time that one sample of each takes in total.
std::vector<MeasuredConfiguration*> leading_ways(std::vector<MeasuredConfiguration>& configurations,
                                                 std::uint32_t samples, double& per_sample_s) {
    std::vector<MeasuredConfiguration*> leading;
    per_sample_s = 0.0;
    for (MeasuredConfiguration& configuration : configurations) {
        if (configuration.levels.empty() || configuration.levels.back().samples != samples) continue;
        leading.push_back(&configuration);
        per_sample_s += median(configuration.levels.back().times_s) / samples;
    }
    return leading;
}

// `reached`: the number of samples that most configurations have.
void measure_rising(const Workshop& workshop, const SamplePlan& plan, std::uint32_t asked,
                    std::vector<MeasuredConfiguration>& configurations, std::uint32_t& reached) {
    std::set<std::uint32_t> counts;
    for (const std::vector<std::uint32_t>& levels : plan.of_configuration)
        counts.insert(levels.begin(), levels.end());
    const std::vector<std::uint32_t> usual = three_levels(plan.top);
    for (const std::uint32_t samples : counts) {
        if (reached != 0 && workshop.left_s() <= 0.0) return;
        std::vector<MeasuredConfiguration*> taking;
        for (std::size_t i = 0; i < configurations.size(); ++i) {
            const std::vector<std::uint32_t>& levels = plan.of_configuration[i];
            if (std::ranges::find(levels, samples) != levels.end()) taking.push_back(&configurations[i]);
        }
        measure_level(workshop, taking, samples);
        if (std::ranges::find(usual, samples) != usual.end()) reached = samples;
        workshop.on_progress(0.8 * samples / plan.top, samples);
    }
    const auto times = static_cast<double>(workshop.repeats);
    double per_sample_s = 0.0;
    while (reached < asked) {
        const std::uint32_t next = std::min(2 * reached, asked);
        const std::vector<MeasuredConfiguration*> leading =
            leading_ways(configurations, reached, per_sample_s);
        if (times * next * per_sample_s > workshop.left_s()) break;
        measure_level(workshop, leading, next);
        reached = next;
        workshop.on_progress(0.9, reached);
    }
    const double base_s = median(configurations.front().levels.back().times_s);
    if (2.0 * times * base_s < workshop.left_s())
        measure_level(workshop, {&configurations.front()}, 2 * reached);
}

}  // namespace

Measured measure_once(RenderSession& session, const MeasureJob& job) {
    RenderSettings settings = job.configuration.settings;
    settings.spp = job.samples;
    settings.seed = job.seed;
    session.change(settings, job.configuration.request);
    Measured measured{.outcome = session.render(job.frame, job.time_limit_s)};
    for (const PassTime& pass : measured.outcome.statistics.passes)
        if (!pass.label.starts_with("world.")) measured.time_s += 1e-3 * pass.ms;
    if (measured.outcome.statistics.stop == StopReason::interrupted)
        throw Error(ExitCode::interrupted, kNothingMeasured);
    return measured;
}

bool is_measured(const std::function<void()>& work) {
    try {
        work();
    } catch (const Error& error) {
        if (error.code() != ExitCode::interrupted) throw;
        return false;
    }
    return true;
}

Json settings_json(const Configuration& configuration, const RenderPlan& plan, std::uint32_t samples) {
    Json json = {{"spp", samples}, {"sequence", name_of(configuration.settings.sequence)}};
    if (plan.has(Effect::voxels)) json["traversal"] = name_of(plan.world.traversal);
    if (plan.has(Effect::ao)) {
        json["ao"] = plan.ao.uses_cells() ? "hash" : "brute";
        json["ao_rays"] = configuration.settings.ao_rays;
        json["ao_cell_px"] = plan.ao.uses_cells() ? Json(configuration.settings.ao.cell_px) : Json();
    }
    if (plan.photons.runs()) {
        json["photons"] = plan.photons.count();
        json["radius"] = plan.photons.radius;
        json["alpha"] = configuration.settings.photons.alpha;
        json["gather"] = photon_method(configuration.settings.photons);
        json["paths"] = configuration.settings.photons.roulette
                            ? std::string("roulette")
                            : fmt::format("depth {}", configuration.settings.photons.depth);
    }
    json["estimate"] = plan.sums_squares ? "squares" : "halves";
    return json;
}

std::vector<MeasuredConfiguration> prepare_configurations(const Workshop& workshop,
                                                          const ParameterDesign& design,
                                                          RenderSession& session,
                                                          const std::function<bool(double)>& may_load) {
    std::vector<MeasuredConfiguration> configurations;
    double loaded_s = 0.0;
    for (std::size_t i = 0; i < design.configurations.size(); ++i) {
        configurations.push_back({.configuration = design.configurations[i]});
        MeasuredConfiguration& configuration = configurations.back();
        if (configuration.configuration.traversal && !may_load(loaded_s))
            configuration.refusal = "there is no time left to build its world";
        else
            prepare_configuration(workshop, session, configuration);
        if (configuration.own) loaded_s = std::max(loaded_s, configuration.load_s);
        workshop.on_progress(static_cast<double>(i + 1) / static_cast<double>(design.configurations.size()),
                             1);
    }
    return configurations;
}

SamplePlan plan_samples(const std::vector<MeasuredConfiguration>& configurations, std::uint32_t asked,
                        std::size_t repeats, double budget_s) {
    const auto times = static_cast<double>(repeats);
    SamplePlan plan;
    for (plan.top = asked;; plan.top /= 2) {
        plan.of_configuration.clear();
        plan.cost_s = 0.0;
        for (std::size_t i = 0; i < configurations.size(); ++i) {
            std::vector<std::uint32_t> levels;
            if (i == 0)
                levels = all_levels(plan.top);
            else if (configurations[i].session != nullptr)
                levels =
                    levels_within(plan.top, configurations[i].per_sample_s, kMaxShare * budget_s / times);
            plan.cost_s += times * cost_of(levels, configurations[i].per_sample_s);
            plan.of_configuration.push_back(std::move(levels));
        }
        if (plan.cost_s <= budget_s || plan.top == 1) break;
    }
    // All are compared with configuration 0, which therefore needs the levels of all.
    std::set<std::uint32_t> all;
    for (const std::vector<std::uint32_t>& levels : plan.of_configuration)
        all.insert(levels.begin(), levels.end());
    plan.of_configuration.front() = {all.begin(), all.end()};
    return plan;
}

std::uint32_t measure_levels(const Workshop& workshop, const SamplePlan& plan, std::uint32_t asked,
                             std::vector<MeasuredConfiguration>& configurations) {
    std::uint32_t reached = 0;
    const bool is_whole =
        is_measured([&] { measure_rising(workshop, plan, asked, configurations, reached); });
    if (!is_whole && reached == 0) throw Error(ExitCode::interrupted, kNothingMeasured);
    return reached;
}

}  // namespace voxilux
