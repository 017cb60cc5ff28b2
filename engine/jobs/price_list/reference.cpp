#include "jobs/price_list/reference.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "estimators/film_error.h"
#include "film/film_sums.h"
#include "frame/footprint.h"
#include "jobs/or_null.h"
#include "jobs/price_list/measure.h"
#include "jobs/price_list/reference_cache.h"
#include "scene/scene_hash.h"

namespace voxilux {
namespace {

using Json = nlohmann::ordered_json;

// Seeds of the two halves, unlikely to be used by any other render of the price list.
constexpr std::array<std::uint32_t, 2> kSeeds = {0x52456641, 0x52456642};
// The radius of photons relative to the scene's: their bias falls with its square. kPhotonFactor times as
// many photons keep the noise the same.
constexpr double kRadiusShare = 0.5;
constexpr std::uint32_t kPhotonFactor = 4;

// A half ends when it has taken this many times the expected time: the machine is busy with other work.
constexpr double kPatience = 1.3;
// Samples that predict the time of a sample.
constexpr std::uint32_t kTimedSamples = 4;

// Joins both halves to one film, whose half a is the first of them.
FilmSums joined(FilmSums a, FilmSums b) {
    const auto collapse = [](FilmSums& film, const std::string& plane) {
        std::vector<std::int64_t>& sums = film.sums.at(plane + "_a");
        const std::vector<std::int64_t>& others = film.sums.at(plane + "_b");
        for (std::size_t i = 0; i < sums.size(); ++i)
            sums[i] += others[i];
    };
    FilmSums film{.width = a.width, .height = a.height};
    for (const std::string plane : {"beauty", "bias"}) {
        if (!a.sums.contains(plane + "_a")) continue;
        collapse(a, plane);
        collapse(b, plane);
        film.sums[plane + "_a"] = std::move(a.sums.at(plane + "_a"));
        film.sums[plane + "_b"] = std::move(b.sums.at(plane + "_a"));
    }
    for (std::size_t row = 0; row < a.even.size(); ++row) {
        film.even.push_back(a.even[row] + a.odd[row]);
        film.odd.push_back(b.even[row] + b.odd[row]);
    }
    return film;
}

Json facts_of(const Reference& reference) {
    const ErrorEstimate& error = reference.error;
    return {{"samples", reference.samples},       {"time_s", reference.time_s},
            {"estimate", error.estimate},         {"low", error.low},
            {"high", finite_or_null(error.high)}, {"noise", error.noise.value_or(error.estimate)},
            {"bias", or_null(error.bias)}};
}

std::optional<Reference> from_cache(const ReferenceJob& job, const std::string& key, glm::ivec2 size) {
    std::optional<CachedPicture> cached = load_cached(job.cache, key, size.x, size.y);
    if (!cached) return {};
    try {
        const Json& facts = cached->facts;
        Reference reference{.image = std::move(cached->image),
                            .samples = facts.at("samples"),
                            .time_s = facts.at("time_s"),
                            .is_cached = true};
        reference.error.estimate = facts.at("estimate");
        reference.error.low = facts.at("low");
        reference.error.high = facts.at("high").is_null() ? std::numeric_limits<double>::infinity()
                                                          : facts.at("high").get<double>();
        if (!facts.at("bias").is_null()) {
            reference.error.noise = facts.at("noise");
            reference.error.bias = facts.at("bias");
        }
        return reference;
    } catch (const Json::exception&) {
        return {};
    }
}

// Everything that the image depends on except the number of samples.
std::string key_of(const RenderSession& session, const RenderPlan& plan) {
    return cache_key(fmt::format("{} {:016x} {}", VX_VERSION, sample_hash(session.scene()), describe(plan)));
}

// kPhotonFactor times the photons of the scene, or as many as fit the device.
std::uint32_t max_photons(RenderSession& session, const ReferenceJob& job, Configuration configuration,
                          std::uint32_t planned) {
    for (std::uint32_t factor = kPhotonFactor; factor > 1; factor /= 2) {
        if (planned > PhotonSettings::kMaxCount / factor) continue;
        configuration.settings.photons.count = factor * planned;
        try {
            (void)measure_once(session,
                               {.configuration = configuration, .frame = job.frame, .seed = kSeeds[0]});
            return configuration.settings.photons.count;
        } catch (const Error& error) {
            if (error.code() != ExitCode::input_refused && error.code() != ExitCode::out_of_memory) throw;
        }
    }
    return planned;
}

}  // namespace

ReferenceNoise Reference::noise() const {
    const double square = std::pow(error.noise.value_or(error.estimate), 2.0);
    // The interval covers noise and bias together, and is symmetric in the logarithm.
    const double ratio = error.estimate > 0.0 ? error.low / error.estimate : 1.0;
    const double spread = std::max(ratio, 0.1);
    return {.square = square, .low = square * spread * spread, .high = square / (spread * spread)};
}

RenderSettings reference_settings(const Configuration& base, const RenderPlan& plan) {
    RenderSettings settings = base.settings;
    // Without occlusion in the plan, naming a method would replace paths by occlusion.
    if (plan.has(Effect::ao)) settings.ao.method = AoMethod::brute;
    if (!plan.photons.runs()) return settings;
    PhotonSettings& photons = settings.photons;
    photons.classic = false;
    photons.scatter = false;
    photons.roulette = true;
    photons.radius = kRadiusShare * photons.radius.value_or(1.0);
    return settings;
}

Reference make_reference(RenderSession& session, const ReferenceJob& job) {
    PlanRequest request = job.base.request;
    request.wants_error = true;
    Measured first = measure_once(
        session, {.configuration = job.base, .frame = job.frame, .seed = kSeeds[0], .samples = 1});
    const bool has_photons = first.outcome.plan.photons.runs();
    Configuration configuration{.settings = reference_settings(job.base, first.outcome.plan),
                                .request = request};
    if (has_photons)
        configuration.settings.photons.count =
            max_photons(session, job, configuration, first.outcome.plan.photons.count());
    const auto half = [&](std::size_t which, std::uint32_t samples) {
        return measure_once(session, {.configuration = configuration,
                                      .frame = job.frame,
                                      .seed = kSeeds[which],
                                      .samples = samples,
                                      .time_limit_s = kPatience * job.budget_s / 2.0});
    };
    first = half(0, 1);
    const double per_sample_s = std::max(half(0, kTimedSamples).time_s / kTimedSamples, 1e-9);
    const double wanted = std::min<double>(job.max_samples, job.budget_s / per_sample_s);
    const auto samples = static_cast<std::uint32_t>(std::max(wanted / 2.0, 1.0));
    const std::string key = key_of(session, first.outcome.plan);
    std::optional<Reference> cached = from_cache(job, key, first.outcome.plan.settings.size);
    if (cached && cached->samples >= samples) {
        cached->settings = settings_json(configuration, first.outcome.plan, cached->samples);
        return std::move(*cached);
    }
    Measured a = half(0, samples), b = half(1, samples);
    const RenderPlan plan = a.outcome.plan;
    const std::uint32_t taken = a.outcome.statistics.samples + b.outcome.statistics.samples;
    const FilmSums film = joined(std::move(*a.outcome.film), std::move(*b.outcome.film));
    Reference reference{.image = colours_alone(picture_of(film)),
                        .samples = taken,
                        .time_s = a.time_s + b.time_s,
                        .error = error_of(film),
                        .settings = settings_json(configuration, plan, taken)};
    (void)store_cached(job.cache, key, {reference.image, facts_of(reference)});
    return reference;
}

}  // namespace voxilux
