#include "jobs/error_rounds.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "jobs/forecast.h"

namespace voxilux {
namespace {

constexpr std::uint32_t kFirstRound = 8;  // samples, where nothing is known
// Factors by which a round decided by the image itself grows it: at least kMinGrowth, so that estimates stay
// few, and at most kMaxGrowth, because a single bright sample may have raised the estimate.
constexpr double kMinGrowth = 1.05;
constexpr double kMaxGrowth = 2.0;
constexpr double kMaxEarlyGrowth = 8.0;
constexpr std::uint32_t kEarly = 64;  // samples
constexpr double kAim = 0.98;         // fraction of the target, after an estimate that exceeded it

}  // namespace

std::string_view name_of(DecidedBy decided_by) {
    switch (decided_by) {
        case DecidedBy::request:
            return "request";
        case DecidedBy::pilot:
            return "pilot";
        case DecidedBy::frame_before:
            return "frame before";
        case DecidedBy::averaged:
            return "averaged samples";
    }
    VX_ASSERT(false);
}

ErrorRounds::ErrorRounds(const ErrorLaw& law, double target, const ErrorPrior& guess, std::uint32_t most,
                         std::uint32_t done)
    : law_(law), target_(target), most_(most), points_(guess.points), decided_by_(guess.from) {
    const auto curve = fit_error(law, points_);
    if (!curve) decided_by_ = DecidedBy::averaged;
    const std::uint32_t planned = curve ? planned_samples(*curve, target).value_or(most) : kFirstRound;
    end_ = std::min(std::max(planned, done), most);
}

bool ErrorRounds::reaches(std::uint32_t samples, const ErrorEstimate& claim) {
    if (claim.high <= target_) return true;
    if (samples >= most_) return false;
    if (const auto point = error_point(samples, claim)) points_.push_back(*point);
    decided_by_ = DecidedBy::averaged;
    ++rounds_;
    // The curve gives the rate at which the estimate falls; the last estimate gives its level.
    const auto curve = fit_error(law_, points_);
    double wanted = 0.0;
    if (curve && std::isfinite(claim.high)) {
        const double aim = kAim * target_ * claimed_error(*curve, samples) / claim.high;
        wanted = samples_for(*curve, aim).value_or(most_);
    }
    const double now = samples;
    const double max_growth = samples < kEarly ? kMaxEarlyGrowth : kMaxGrowth;
    const double next = std::clamp(wanted, std::ceil(kMinGrowth * now) + 1.0, max_growth * now);
    end_ = static_cast<std::uint32_t>(std::min(next, static_cast<double>(most_)));
    end_ = std::min(end_ + end_ % 2, most_);  // halves of equal size
    return false;
}

}  // namespace voxilux
