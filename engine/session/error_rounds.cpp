#include "session/error_rounds.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "session/forecast.h"

namespace voxilux {
namespace {

constexpr std::uint32_t kFirstRound = 8;  // samples, where nothing is known
// A round that its own picture decides grows it by this at least, so that looks stay few; and by that at most
// while the first claims of few samples say little.
constexpr double kLeastGrowth = 1.05;
constexpr double kMostGrowth = 8.0;

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

ErrorRounds::ErrorRounds(const ErrorLaw& law, double target, const ErrorGuess& guess, std::uint32_t most,
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
    const auto curve = fit_error(law_, points_);
    const double wanted = curve ? planned_samples(*curve, target_).value_or(most_) : 0.0;
    const double now = samples;
    const double next = std::clamp(wanted, std::ceil(kLeastGrowth * now) + 1.0, kMostGrowth * now);
    end_ = static_cast<std::uint32_t>(std::min(next, static_cast<double>(most_)));
    end_ = std::min(end_ + end_ % 2, most_);  // halves of one size
    return false;
}

}  // namespace voxilux
