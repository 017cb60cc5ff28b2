#include "jobs/error_watch.h"

#include <algorithm>

namespace voxilux {
namespace {

// Reading the film costs about as much as one sample. For progress alone it is read when the number of
// samples has doubled and this much time has passed.
constexpr double kLookEvery_s = 2.0;
constexpr std::uint32_t kFirstLook = 8;

}  // namespace

ErrorWatch::ErrorWatch(const ErrorLaw& law, std::vector<ErrorPoint> known)
    : law_(law), known_(known.size()), points_(std::move(known)), curve_(fit_error(law_, points_)) {}

void ErrorWatch::add(std::uint32_t samples, const ErrorEstimate& claim, double now_s) {
    last_samples_ = samples;
    last_s_ = now_s;
    if (const auto point = error_point(samples, claim)) points_.push_back(*point);
    curve_ = fit_error(law_, points_);
}

bool ErrorWatch::is_due(std::uint32_t samples, double now_s) const {
    return now_s - last_s_ >= kLookEvery_s && samples >= std::max(2 * last_samples_, kFirstLook);
}

std::optional<ErrorCurve> ErrorWatch::curve_with(std::uint32_t samples, const ErrorEstimate& claim) const {
    std::vector<ErrorPoint> points = points_;
    if (const auto point = error_point(samples, claim)) points.push_back(*point);
    return fit_error(law_, points);
}

std::vector<ErrorPoint> ErrorWatch::own_points() const {
    return {points_.begin() + static_cast<std::ptrdiff_t>(known_), points_.end()};
}

}  // namespace voxilux
