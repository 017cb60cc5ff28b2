// Let X = E + R be a sample, E what an effect adds and R the sample without it from the same random numbers.
// Then Var(X) = Cov(E, X) + Cov(R, X): the effect's fraction is Cov(X - R, X) / Var(X), whatever else R is
// the sum of. It is half the derivative of log Var(X) by a factor on E. Both are estimated from the
// differences of two halves, D of X and D' of R: E[D (D - D')] is the same multiple of Cov(E, X) as E[D^2] is
// of Var(X), so that neither means nor a reference are needed.

#include "jobs/noise_shares.h"

#include <algorithm>
#include <span>

#include "base/assert.h"
#include "base/statistics.h"
#include "estimators/metrics.h"
#include "film/film.h"
#include "renderer/pilot_film.h"

namespace voxilux {
namespace {

constexpr std::uint32_t kShareSamples = 4;  // the sum over all pixels makes up for so few

// Why the noise of an effect cannot be measured; empty when it can.
std::string reason_without_share(Effect effect) {
    switch (effect) {
        case Effect::voxels:
        case Effect::spheres:
            return "at edges, its noise is that of whatever is seen there";
        case Effect::specular:
            return "all other effects are seen through it";
        case Effect::sky:
        case Effect::emission:
            return "it is the same in every sample that sees it";
        default:
            return {};
    }
}

FilmSums render_film(const ShareJob& job, const RenderPlan& plan, Executor& executor) {
    PilotFilm film(plan, job.prepared, job.scene, executor, job.is_cpu);
    for (std::uint32_t sample = 0; sample < kShareSamples; ++sample)
        (void)film.take(sample);
    return film.read();
}

struct CountedHalves {
    std::array<std::uint64_t, 1> even;
    std::array<std::uint64_t, 1> odd;
    FilmHalf a, b;

    explicit CountedHalves(const FilmSums& film)
        : even{film.even.at(0)},
          odd{film.odd.at(0)},
          a{film.sums.at("beauty_a"), even},
          b{film.sums.at("beauty_b"), odd} {}
    CountedHalves(const CountedHalves&) = delete;
    CountedHalves& operator=(const CountedHalves&) = delete;
};

}  // namespace

double noise_share(const FilmSums& with, const FilmSums& without) {
    VX_ASSERT(with.width == without.width && with.height == without.height);
    const CountedHalves of_all(with), of_rest(without);
    CompensatedSum whole, part;
    const std::size_t pixels = static_cast<std::size_t>(with.width) * static_cast<std::size_t>(with.height);
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        const HalfMeans all = half_means(of_all.a, of_all.b, pixel);
        const HalfMeans rest = half_means(of_rest.a, of_rest.b, pixel);
        for (std::size_t c = 0; c < 3; ++c) {
            const double difference = all.a[c] - all.b[c];
            const double weight = 1.0 / (all.mean[c] * all.mean[c] + kRelMseEpsilon);
            whole.add(difference * difference * weight);
            part.add(difference * (difference - (rest.a[c] - rest.b[c])) * weight);
        }
    }
    return whole.value() > 0.0 ? part.value() / whole.value() : 0.0;
}

std::vector<NoiseShare> share_noise(const ShareJob& job, Executor& executor) {
    std::vector<NoiseShare> shares;
    double films = 1.0;
    for (const EffectState& state : job.prepared.plan.effects) {
        if (!state.on || state.effect == Effect::aov) continue;
        shares.push_back({.effect = state.effect, .reason = reason_without_share(state.effect)});
        if (shares.back().reason.empty()) films += 1.0;
    }
    const bool is_expensive = films * kShareSamples * job.sample_s > job.budget_s;
    // All effects but AOVs, whose sums the comparison does not need.
    const FilmSums all =
        is_expensive ? FilmSums{} : render_film(job, plan_without(job.prepared.plan, Effect::aov), executor);
    for (NoiseShare& share : shares) {
        if (!share.reason.empty()) continue;
        if (is_expensive || (job.stops && job.stops())) {
            share.reason = "a sample takes too long to measure it";
            continue;
        }
        share.share =
            noise_share(all, render_film(job, plan_without(job.prepared.plan, share.effect), executor));
    }
    return shares;
}

}  // namespace voxilux
