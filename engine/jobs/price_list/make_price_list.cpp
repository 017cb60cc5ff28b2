#include "jobs/price_list/make_price_list.h"

#include <algorithm>

#include "base/clock.h"
#include "estimators/difference_estimate.h"
#include "scene/scene_hash.h"

namespace voxilux {
namespace {

// How the time is divided. The rest is for compiling, reading back, comparing and writing.
constexpr double kReferenceShare = 0.30;
constexpr double kEffectShare = 0.10;
constexpr double kRunShare = 0.30;  // planned runs; more are made until kRunsEnd
constexpr double kRunsEnd = 0.80;   // since the start
constexpr double kRowsEnd = 0.95;
constexpr double kMaxRowShare = 0.02;  // for one image of equal error
constexpr double kLoadShare = 0.04;    // for building a configuration's own world
// A reference is useful with up to this many times the samples of the longest run: its noise is then an
// eighth.
constexpr double kReferenceSamples = 64.0;
constexpr double kMaxEffectSamples = 64.0;
constexpr double kEffectTrials = 5.0;  // times of short renders vary

bool is_interrupted(const PriceListJob& job) {
    return job.options.interrupted != nullptr && job.options.interrupted->load();
}

// The time that remains of a fraction of the job's time.
double left_s(const PriceListJob& job, double share) {
    if (is_interrupted(job)) return 0.0;
    return share * job.time_limit_s - seconds_since(job.options.started);
}

// Progress of the whole job: stages one after the other, each with a weight.
class Stages {
  public:
    explicit Stages(const PriceListJob& job) : job_(job) {}

    void begin(double from, double to) {
        from_ = from;
        to_ = to;
        show(0.0, 0);
    }

    void show(double share, std::uint32_t samples) const {
        if (!job_.on_progress) return;
        const double done = from_ + share * (to_ - from_);
        const double elapsed = seconds_since(job_.options.started);
        job_.on_progress({.done = done,
                          .elapsed_s = elapsed,
                          .remaining_s = done > 0.0 ? elapsed * (1.0 - done) / done : job_.time_limit_s,
                          .sample = samples});
    }

  private:
    const PriceListJob& job_;
    double from_ = 0.0;
    double to_ = 0.0;
};

std::vector<EffectPrice> price_all(RenderSession& session, const Workshop& workshop,
                                   const Configuration& base, double per_sample_s, double budget_s) {
    const double rounds =
        budget_s / (static_cast<double>(kEffectCount) * per_sample_s);  // of one sample each
    const double trials = std::clamp(rounds, double{kMinTrials}, kEffectTrials);
    const double samples = std::clamp(rounds / trials, 1.0, kMaxEffectSamples);
    return price_effects(session, {.frame = workshop.frame,
                                   .settings = base.settings,
                                   .request = base.request,
                                   .samples = static_cast<std::uint32_t>(samples),
                                   .trials = std::max(workshop.repeats, static_cast<std::size_t>(trials))});
}

// Takes one sample, which finds the radius of photons.
Measured first_picture(RenderSession& session, const Scene& scene, const Workshop& workshop) {
    const Configuration configuration{.settings = scene.settings, .request = workshop.options.plan};
    return measure_once(session,
                        {.configuration = configuration, .frame = workshop.frame, .seed = workshop.seed});
}

// All configurations use the radius of photons that the first image found, so that they differ in one setting
// only.
Configuration base_way(const Scene& scene, const Workshop& workshop, const RenderPlan& plan) {
    Configuration base{.settings = scene.settings, .request = workshop.options.plan};
    if (plan.photons.runs()) base.settings.photons.radius = plan.photons.radius;
    return base;
}

ReferenceJob reference_job(const PriceListJob& job, const Configuration& base) {
    const double most = kReferenceSamples * 2.0 * base.settings.spp;
    return {.frame = job.frame,
            .base = base,
            .cache = job.references,
            .max_samples = static_cast<std::uint32_t>(std::min(most, 1e9)),
            .budget_s = kReferenceShare * job.time_limit_s};
}

// Measures the runs and the rows of images; configurations, reference and effects must exist.
void measure_runs(Workshop& workshop, const SamplePlan& samples, const PriceListJob& job, Stages& stages,
                  PriceList& list) {
    stages.begin(0.5, 0.85);
    workshop.left_s = [&] { return left_s(job, kRunsEnd); };
    list.top = measure_levels(workshop, samples, list.asked, list.configurations);
    stages.begin(0.85, 0.99);
    workshop.left_s = [&] { return left_s(job, kRowsEnd); };
    list.equal_time = equal_time_row(workshop, list.design, list.configurations, list.top);
    list.equal_error = equal_error_row(workshop, list.design, list.configurations, list.top,
                                       kMaxRowShare * job.time_limit_s);
}

}  // namespace

PriceList make_price_list(const PriceListJob& job) {
    const Scene& scene = job.scene;
    Stages stages(job);
    Workshop workshop{.scene = scene,
                      .options = job.options,
                      .frame = job.frame,
                      .seed = scene.settings.seed,
                      .repeats = job.repeats};
    workshop.options.keeps_film = true;  // the reference is made from sums
    workshop.on_progress = [&](double share, std::uint32_t samples) { stages.show(share, samples); };
    RenderSession session(scene, workshop.options);
    const Measured first = first_picture(session, scene, workshop);
    const Configuration base = base_way(scene, workshop, first.outcome.plan);
    PriceList list{.scene = job.name,
                   .scene_hash = scene_hash(scene),
                   .seed = scene.settings.seed,
                   .device = first.outcome.statistics.device,
                   .repeats = workshop.repeats,
                   .design = design_parameters(first.outcome.plan, base),
                   .asked = scene.settings.spp};
    const double limit_s = job.time_limit_s;
    stages.begin(0.0, 0.1);
    list.configurations = prepare_configurations(
        workshop, list.design, session, [&](double load_s) { return load_s < kLoadShare * limit_s; });
    const SamplePlan samples =
        plan_samples(list.configurations, list.asked, workshop.repeats, kRunShare * limit_s);
    stages.begin(0.1, 0.4);
    list.reference = make_reference(session, reference_job(job, base));
    workshop.reference = &list.reference.image;
    workshop.noise = list.reference.noise();
    stages.begin(0.4, 0.5);
    list.effects =
        price_all(session, workshop, base, list.configurations.front().per_sample_s, kEffectShare * limit_s);
    measure_runs(workshop, samples, job, stages, list);
    list.wall_s = seconds_since(job.options.started);
    return list;
}

}  // namespace voxilux
