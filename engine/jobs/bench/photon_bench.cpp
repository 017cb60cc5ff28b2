#include "jobs/bench/photon_bench.h"

#include <algorithm>
#include <limits>
#include <memory>

#include "base/error.h"
#include "base/stopwatch.h"
#include "jobs/bench/contest.h"
#include "jobs/render_session.h"

namespace voxilux {
namespace {

constexpr std::uint32_t kMinPhotons = 1u << 12;
constexpr std::uint32_t kMaxPhotons = 1u << 18;
constexpr int kSmallestEdge = 64;
constexpr int kLargestEdge = 512;
// Iterations of the rows where photons or pixels grow: enough for a mean, and few enough for the largest row.
constexpr std::uint32_t kGrowthIterations = 16;
// A time limit that every sample exceeds: the render ends after the first.
constexpr double kNoTime = 1e-9;

// A row and its renderer.
struct PhotonContestant {
    const PhotonBenchOptions& options;
    PhotonRow row;
    std::unique_ptr<RenderSession> session;

    void warm_up();
    void take_turn();
};

PhotonContestant enter(const Scene& base, const PhotonVariant& variant, const PhotonBenchOptions& options) {
    Scene scene = base;
    RenderSettings& settings = scene.settings;
    settings.photons = settings_of(variant, settings.photons);
    settings.spp = iterations_of(variant, settings.spp);
    PhotonContestant contestant{.options = options};
    contestant.row = {.variant = variant,
                      .size = settings.size,
                      .iterations = settings.spp,
                      .alpha = settings.photons.alpha,
                      .wall_s = std::numeric_limits<double>::infinity()};
    contestant.session = std::make_unique<RenderSession>(
        std::move(scene), RenderOptions{.device = {.selector = options.device}});
    return contestant;
}

// Takes one iteration, which compiles the shaders.
void PhotonContestant::warm_up() {
    const RenderOutcome outcome = session->render(0, kNoTime);
    if (!outcome.plan.photons.runs()) {
        const auto& state = outcome.plan.effects[static_cast<std::size_t>(Effect::indirect)];
        throw Error(ExitCode::input_refused, fmt::format("no photons are called for: {}", state.reason));
    }
    row.photons = outcome.plan.photons.count();
    row.radius = outcome.plan.photons.radius;
}

std::uint64_t count_of(const RenderOutcome& outcome, const char* name) {
    const auto found = outcome.statistics.work.find(name);
    return found == outcome.statistics.work.end() ? 0 : found->second;
}

void PhotonContestant::take_turn() {
    const Stopwatch watch;
    const RenderOutcome outcome = session->render(0, std::nullopt);
    const Seconds seconds = watch.elapsed();
    if (seconds.wall >= row.wall_s) return;
    row.wall_s = seconds.wall;
    row.cpu_s = seconds.cpu;
    row.passes_ms.clear();
    for (const PassTime& pass : outcome.statistics.passes)
        row.passes_ms[pass.label] += pass.ms / row.iterations;
    row.stored = count_of(outcome, "photons_stored");
    row.segments = count_of(outcome, "path_segments");
    row.faults = 0;
    for (const auto& [fault, count] : outcome.statistics.faults)
        row.faults += count;
    const auto& reference = options.reference;
    if (reference && reference->width == row.size.x && reference->height == row.size.y)
        row.errors = photon_errors(*reference, outcome.image, options.box);
}

std::vector<PhotonRow> run_series(std::vector<PhotonContestant>& contestants, const std::string& name,
                                  const std::string& series) {
    run_contest(contestants, contestants.front().options.rounds);
    std::vector<PhotonRow> rows = rows_of(contestants);
    for (PhotonRow& row : rows) {
        row.scene = name;
        row.series = series;
    }
    return rows;
}

// The jobs of a series.
std::vector<Scene> grow(const Scene& base, const std::string& series) {
    std::vector<Scene> jobs;
    Scene job = base;
    if (series == "iterations") {
        for (std::uint32_t divisor = 16; divisor >= 1; divisor /= 4) {
            job.settings.spp = std::max(base.settings.spp / divisor, 1u);
            jobs.push_back(job);
        }
        return jobs;
    }
    job.settings.spp = std::min(base.settings.spp, kGrowthIterations);
    if (series == "photons") {
        for (std::uint32_t count = kMinPhotons; count <= kMaxPhotons; count *= 2) {
            job.settings.photons.count = count;
            jobs.push_back(job);
        }
        return jobs;
    }
    for (int edge = kSmallestEdge; edge <= kLargestEdge; edge *= 2) {
        job.settings.size = {edge, edge};
        jobs.push_back(job);
    }
    return jobs;
}

}  // namespace

const std::vector<std::string>& photon_series() {
    static const std::vector<std::string> series = {"photons", "size", "iterations"};
    return series;
}

void bench_photons(const std::string& name, const Scene& scene, const PhotonBenchOptions& options,
                   const std::function<void(const std::vector<PhotonRow>&)>& on_rows) {
    VX_ASSERT(!options.variants.empty());
    std::vector<PhotonContestant> contestants;
    for (const PhotonVariant& variant : options.variants)
        contestants.push_back(enter(scene, variant, options));
    on_rows(run_series(contestants, name, "options"));
    for (const std::string& series : options.growth) {
        contestants.clear();
        for (const Scene& job : grow(scene, series))
            contestants.push_back(enter(job, options.variants.front(), options));
        on_rows(run_series(contestants, name, series));
    }
}

}  // namespace voxilux
