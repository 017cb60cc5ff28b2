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

// Steps through all seeds: the golden ratio of 2^32 and the square of it.
constexpr std::uint32_t kRepeatStep = 0x9E3779B9;
constexpr std::uint32_t kLevelStep = 0x61C88647;
// Share of the budget that one way may take before it gets fewer samples.
constexpr double kMostShare = 0.12;

std::uint32_t seed_of(const Workshop& workshop, std::size_t repeat, std::uint32_t samples) {
    return workshop.seed + static_cast<std::uint32_t>(repeat + 1) * kRepeatStep + (samples + 7) * kLevelStep;
}

void warm_up(const Workshop& workshop, MeasuredWay& way) {
    const MeasureJob job{.way = way.way, .frame = workshop.frame, .seed = workshop.seed};
    const RenderOutcome first = measure_once(*way.session, job).outcome;
    way.load_s = first.statistics.load_s;
    const Measured second = measure_once(*way.session, job);
    const Measured third = measure_once(*way.session, job);
    way.plan = second.outcome.plan;
    way.per_sample_s = std::max(std::min(second.time_s, third.time_s), 1e-6);
}

void open_way(const Workshop& workshop, RenderSession& session, MeasuredWay& way) {
    try {
        if (way.way.traversal) {
            RenderOptions options = workshop.options;
            options.plan = way.way.request;
            options.plan.traversal = way.way.traversal;
            options.started = std::chrono::steady_clock::now();
            way.own = std::make_unique<RenderSession>(workshop.scene, options);
        }
        way.session = way.own ? way.own.get() : &session;
        warm_up(workshop, way);
    } catch (const Error& error) {
        if (error.code() != ExitCode::input_refused && error.code() != ExitCode::out_of_memory) throw;
        way.refusal = error.what();
        way.own.reset();
        way.session = nullptr;
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

// The levels of a way that must not take longer than `most_s`.
std::vector<std::uint32_t> levels_within(std::uint32_t top, double per_sample_s, double most_s) {
    while (top > 1 && cost_of(three_levels(top), per_sample_s) > most_s)
        top = std::max(top / 4, 1u);
    return three_levels(top);
}

struct Round {
    MeasuredWay* way = nullptr;
    std::vector<Image> pictures;
    Level level;
};

void measure_round(const Workshop& workshop, std::vector<Round>& rounds, std::uint32_t samples) {
    for (std::size_t repeat = 0; repeat < workshop.repeats; ++repeat) {
        for (Round& round : rounds) {
            Measured measured = measure_once(*round.way->session, {.way = round.way->way,
                                                                   .frame = workshop.frame,
                                                                   .seed = seed_of(workshop, repeat, samples),
                                                                   .samples = samples});
            round.level.times_s.push_back(measured.time_s);
            if (repeat == 0) round.level.claimed = measured.outcome.statistics.error;
            round.pictures.push_back(colours_of(std::move(measured.outcome.image)));
        }
    }
}

void finish_round(const Workshop& workshop, std::vector<Round>& rounds, std::uint32_t samples) {
    const Round& base = rounds.front();
    for (Round& round : rounds) {
        round.level.samples = samples;
        round.level.error = split_error(round.pictures, *workshop.reference, workshop.noise);
        if (!round.way->other_pixels)
            round.way->other_pixels = differing_pixels(round.pictures.front(), base.pictures.front());
    }
    for (Round& round : rounds) {
        round.level.picture = std::move(round.pictures.front());
        // Of way 0 every picture is shown, of the others the last.
        if (&round != &rounds.front() && !round.way->levels.empty()) round.way->levels.back().picture = {};
        round.way->levels.push_back(std::move(round.level));
    }
}

void measure_level(const Workshop& workshop, const std::vector<MeasuredWay*>& ways, std::uint32_t samples) {
    std::vector<Round> rounds;
    for (MeasuredWay* const way : ways)
        rounds.push_back({.way = way});
    measure_round(workshop, rounds, samples);
    finish_round(workshop, rounds, samples);
}

// The ways that have taken as many samples as most, and how long one sample of all of them takes.
std::vector<MeasuredWay*> leading_ways(std::vector<MeasuredWay>& ways, std::uint32_t samples,
                                       double& per_sample_s) {
    std::vector<MeasuredWay*> leading;
    per_sample_s = 0.0;
    for (MeasuredWay& way : ways) {
        if (way.levels.empty() || way.levels.back().samples != samples) continue;
        leading.push_back(&way);
        per_sample_s += median(way.levels.back().times_s) / samples;
    }
    return leading;
}

}  // namespace

Image colours_of(Image image) {
    std::erase_if(image.channels, [](const auto& channel) {
        return channel.first != "R" && channel.first != "G" && channel.first != "B";
    });
    return image;
}

Measured measure_once(RenderSession& session, const MeasureJob& job) {
    RenderSettings settings = job.way.settings;
    settings.spp = job.samples;
    settings.seed = job.seed;
    session.change(settings, job.way.request);
    Measured measured{.outcome = session.render(job.frame, job.time_limit_s)};
    for (const PassTime& pass : measured.outcome.statistics.passes)
        if (!pass.label.starts_with("world.")) measured.time_s += 1e-3 * pass.ms;
    return measured;
}

Json settings_json(const Way& way, const RenderPlan& plan, std::uint32_t samples) {
    Json json = {{"spp", samples}, {"sequence", name_of(way.settings.sequence)}};
    if (plan.has(Effect::voxels)) json["traversal"] = name_of(plan.world.traversal);
    if (plan.has(Effect::ao)) {
        json["ao"] = plan.ao.uses_cells() ? "hash" : "brute";
        json["ao_rays"] = way.settings.ao_rays;
        json["ao_cell_px"] = plan.ao.uses_cells() ? Json(way.settings.ao.cell_px) : Json();
    }
    if (plan.photons.runs()) {
        json["photons"] = plan.photons.count();
        json["radius"] = plan.photons.radius;
        json["alpha"] = way.settings.photons.alpha;
        json["gather"] = photon_method(way.settings.photons);
        json["paths"] = way.settings.photons.roulette ? std::string("roulette")
                                                      : fmt::format("depth {}", way.settings.photons.depth);
    }
    json["estimate"] = plan.sums_squares ? "squares" : "halves";
    return json;
}

std::vector<MeasuredWay> open_ways(const Workshop& workshop, const KnobDesign& design, RenderSession& session,
                                   const std::function<bool(double)>& may_load) {
    std::vector<MeasuredWay> ways;
    double loaded_s = 0.0;
    for (std::size_t i = 0; i < design.ways.size(); ++i) {
        ways.push_back({.way = design.ways[i]});
        MeasuredWay& way = ways.back();
        if (way.way.traversal && !may_load(loaded_s))
            way.refusal = "there is no time left to build its world";
        else
            open_way(workshop, session, way);
        if (way.own) loaded_s = std::max(loaded_s, way.load_s);
        workshop.on_progress(static_cast<double>(i + 1) / static_cast<double>(design.ways.size()), 1);
    }
    return ways;
}

SamplePlan plan_samples(const std::vector<MeasuredWay>& ways, std::uint32_t asked, std::size_t repeats,
                        double budget_s) {
    const auto times = static_cast<double>(repeats);
    SamplePlan plan;
    for (plan.top = asked;; plan.top /= 2) {
        plan.of_way.clear();
        plan.cost_s = 0.0;
        for (std::size_t i = 0; i < ways.size(); ++i) {
            std::vector<std::uint32_t> levels;
            if (i == 0)
                levels = all_levels(plan.top);
            else if (ways[i].session != nullptr)
                levels = levels_within(plan.top, ways[i].per_sample_s, kMostShare * budget_s / times);
            plan.cost_s += times * cost_of(levels, ways[i].per_sample_s);
            plan.of_way.push_back(std::move(levels));
        }
        if (plan.cost_s <= budget_s || plan.top == 1) break;
    }
    // All are compared with way 0, which so needs the levels of all.
    std::set<std::uint32_t> all;
    for (const std::vector<std::uint32_t>& levels : plan.of_way)
        all.insert(levels.begin(), levels.end());
    plan.of_way.front() = {all.begin(), all.end()};
    return plan;
}

std::uint32_t measure_levels(const Workshop& workshop, const SamplePlan& plan, std::uint32_t asked,
                             std::vector<MeasuredWay>& ways) {
    std::set<std::uint32_t> counts;
    for (const std::vector<std::uint32_t>& levels : plan.of_way)
        counts.insert(levels.begin(), levels.end());
    const std::vector<std::uint32_t> usual = three_levels(plan.top);
    std::uint32_t reached = 0;
    for (const std::uint32_t samples : counts) {
        if (reached != 0 && workshop.left_s() <= 0.0) return reached;
        std::vector<MeasuredWay*> taking;
        for (std::size_t i = 0; i < ways.size(); ++i) {
            const std::vector<std::uint32_t>& levels = plan.of_way[i];
            if (std::ranges::find(levels, samples) != levels.end()) taking.push_back(&ways[i]);
        }
        measure_level(workshop, taking, samples);
        if (std::ranges::find(usual, samples) != usual.end()) reached = samples;
        workshop.on_progress(0.8 * samples / plan.top, samples);
    }
    const auto times = static_cast<double>(workshop.repeats);
    double per_sample_s = 0.0;
    while (reached < asked) {
        const std::uint32_t next = std::min(2 * reached, asked);
        const std::vector<MeasuredWay*> leading = leading_ways(ways, reached, per_sample_s);
        if (times * next * per_sample_s > workshop.left_s()) break;
        measure_level(workshop, leading, next);
        reached = next;
        workshop.on_progress(0.9, reached);
    }
    const double base_s = median(ways.front().levels.back().times_s);
    if (2.0 * times * base_s < workshop.left_s()) measure_level(workshop, {&ways.front()}, 2 * reached);
    return reached;
}

}  // namespace voxilux
