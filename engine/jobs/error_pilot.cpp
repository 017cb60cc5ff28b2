#include "jobs/error_pilot.h"

#include <algorithm>

#include "base/assert.h"
#include "base/clock.h"
#include "estimators/film_error.h"
#include "plan/error_law.h"
#include "renderer/pilot_film.h"

namespace voxilux {
namespace {

constexpr std::uint32_t kFirstPilotLook = 4;  // samples: with fewer, a film hardly knows its own luminance
// Where the time of a sample depends on its number, because photon kernels shrink, this many are also timed
// at half and at the end of the expected render.
constexpr std::uint32_t kLateSamples = 2;

double samples_needed(const ErrorPilot& pilot, double error) {
    const auto curve = fit_error(pilot.law, pilot.points);
    if (!curve) return 0.0;
    return samples_for(*curve, error).value_or(kMaxSamples);
}

void time_late_samples(const PilotJob& job, PilotFilm& film, ErrorPilot& pilot) {
    if (!job.prepared.plan.any(&Technique::uneven_samples)) return;
    const auto needed = static_cast<std::uint32_t>(samples_needed(pilot, job.error));
    for (const std::uint32_t number : {needed / 2, needed}) {
        if (number < 2 * pilot.samples) continue;
        for (std::uint32_t i = 0; i < kLateSamples; ++i) {
            if (job.stops && job.stops()) return;
            pilot.times.push_back({static_cast<double>(number + i), film.take(number + i - 1)});
        }
    }
}

}  // namespace

bool doubles_pilot(std::uint32_t samples, double pixels, double needed) {
    if (samples < kMinPilotSamples) return true;
    const double doubled = 2.0 * samples;
    if (doubled > kMaxPilotSamples || doubled > needed) return false;
    return doubled <= kPilotShare * needed || doubled * pixels <= kPilotWork;
}

ErrorPilot run_error_pilot(const PilotJob& job, Executor& executor) {
    const RenderPlan& plan = job.prepared.plan;
    VX_ASSERT(!plan.any(&Technique::keeps_state));
    ErrorPilot pilot{.law = error_law(plan)};
    PilotFilm film(plan, job.prepared, job.scene, executor, job.is_cpu);
    const double pixels =
        static_cast<double>(plan.settings.size.x) * static_cast<double>(plan.settings.size.y);
    std::uint32_t look = kFirstPilotLook;
    do {
        for (; pilot.samples < look; ++pilot.samples) {
            if (job.stops && job.stops()) {
                pilot.is_complete = false;
                return pilot;
            }
            const double seconds = film.take(pilot.samples);
            if (pilot.samples > 0) pilot.times.push_back({pilot.samples + 1.0, seconds});
        }
        const auto start = std::chrono::steady_clock::now();
        if (const auto point = error_point(look, error_of(film.read()))) pilot.points.push_back(*point);
        pilot.film_s = seconds_since(start);
        look *= 2;
    } while (doubles_pilot(pilot.samples, pixels, samples_needed(pilot, job.error)));
    time_late_samples(job, film, pilot);
    return pilot;
}

}  // namespace voxilux
