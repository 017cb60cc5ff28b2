#include "jobs/render_outcome.h"

#include <limits>

#include "estimators/film_error.h"

namespace voxilux {

void add_step(const StepResult& step, const RenderPlan& plan, RenderStatistics& statistics) {
    for (std::size_t i = 0; i < gpu::kCounterCount; ++i) {
        auto& table = i < gpu::kFaultCount ? statistics.faults : statistics.work;
        table[gpu::kCounterNames[i]] += step.counters[i];
    }
    if (plan.photons.runs()) statistics.work["photons_emitted"] += step.tiles * plan.photons.count();
    if (plan.rays.primary != 0) statistics.work["primary_rays"] += step.pixels;
    add_times(statistics.passes, step.passes);
    add_step_times(statistics.steps, step.built);
    for (const PassTime& pass : step.passes)
        statistics.gpu_ms += pass.ms;
}

bool lacks_light(const std::map<std::string, std::uint64_t>& faults) {
    for (std::size_t i = 0; i < gpu::kFaultCount; ++i) {
        const auto fault = faults.find(gpu::kCounterNames[i]);
        // Hits that find the table full trace rays of their own.
        if (i != gpu::kFaultAoTableFull && fault != faults.end() && fault->second != 0) return true;
    }
    return false;
}

ErrorEstimate claim_with(ErrorEstimate error, const std::map<std::string, std::uint64_t>& faults) {
    if (lacks_light(faults)) error.high = std::numeric_limits<double>::infinity();
    return error;
}

ErrorEstimate claimed_error_of(const FilmSums& film, const std::map<std::string, std::uint64_t>& faults) {
    return claim_with(error_of(film), faults);
}

double sampling_ms(const RenderStatistics& statistics) {
    double ms = 0.0;
    for (const PassTime& pass : statistics.passes)
        if (!pass.label.starts_with("world.")) ms += pass.ms;
    return ms;
}

}  // namespace voxilux
