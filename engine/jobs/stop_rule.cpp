#include "jobs/stop_rule.h"

#include "plan/error_law.h"

namespace voxilux {

StopRule::StopRule(const RenderOptions& options, const RenderPlan& plan, const ErrorPrior& guess,
                   std::uint32_t done)
    : options_(options), max_samples_(plan.samples()) {
    if (options.error_target)
        rounds_.emplace(error_law(plan), *options.error_target, guess, max_samples_, done);
}

bool StopRule::is_done(std::uint32_t samples, const std::function<ErrorEstimate()>& measure) {
    if (rounds_ && samples >= rounds_->end() && rounds_->reaches(samples, measure())) {
        reason_ = StopReason::error_target;
        return true;
    }
    return samples >= max_samples_;
}

bool StopRule::stops_before(double end_s, std::uint32_t samples) {
    if (options_.interrupted != nullptr && options_.interrupted->load()) {
        reason_ = StopReason::interrupted;
        return true;
    }
    if (options_.time_limit_s && samples > 0 && end_s + end_s_ >= *options_.time_limit_s) {
        reason_ = StopReason::time_limit;
        return true;
    }
    return false;
}

}  // namespace voxilux
