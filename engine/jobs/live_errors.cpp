#include "jobs/live_errors.h"

#include <algorithm>
#include <cmath>

namespace voxilux {

void LiveErrors::start(const ErrorLaw& law) {
    const std::optional<double> target = target_;
    *this = {};
    law_ = law;
    target_ = target;
}

void LiveErrors::add(std::uint32_t samples, const ErrorEstimate& claim) {
    next_look_ = 2 * samples;
    if (const auto point = error_point(samples, claim)) {
        claims_.push_back(*point);
        points_.push_back({samples, seconds_, claim.estimate, claim.high});
        curve_ = fit_error(law_, claims_);
    }
    if (!target_) return;
    if (const auto enough = samples_until(*target_))
        next_look_ = std::clamp(*enough, samples + 1, next_look_);
}

bool LiveErrors::has_reached_target() const {
    return target_ && !points_.empty() && points_.back().high <= *target_;
}

std::optional<double> LiveErrors::expected(double samples) const {
    if (!curve_) return std::nullopt;
    return expected_error(*curve_, samples);
}

std::optional<std::uint32_t> LiveErrors::samples_until(double error) const {
    if (!curve_) return std::nullopt;
    return samples_for(*curve_, error);
}

std::optional<double> LiveErrors::seconds_until(double error) const {
    const auto samples = samples_until(error);
    if (!samples || points_.empty()) return std::nullopt;
    const LiveError& last = points_.back();
    return std::max(*samples * last.seconds / last.samples - seconds_, 0.0);
}

}  // namespace voxilux
