#include "jobs/render_outcome.h"

namespace voxilux {

void add_step(const StepResult& step, const RenderPlan& plan, RenderStatistics& statistics) {
    for (std::size_t i = 0; i < gpu::kCounterCount; ++i) {
        auto& table = i < gpu::kFaultCount ? statistics.faults : statistics.work;
        table[gpu::kCounterNames[i]] += step.counters[i];
    }
    if (plan.photons.runs()) statistics.work["photons_emitted"] += step.tiles * plan.photons.count();
    if (plan.rays.primary != 0) statistics.work["primary_rays"] += step.pixels;
    add_times(statistics.passes, step.passes);
    for (const PassTime& pass : step.passes)
        statistics.gpu_ms += pass.ms;
}

double sampling_ms(const RenderStatistics& statistics) {
    double ms = 0.0;
    for (const PassTime& pass : statistics.passes)
        if (!pass.label.starts_with("world.")) ms += pass.ms;
    return ms;
}

}  // namespace voxilux
