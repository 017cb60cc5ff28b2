#include "view/resolution.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace voxilux {
namespace {

// A change of size loses the occlusion cells that earlier frames filled, so it has to be worth it.
constexpr double kTooSlow = 1.2;
constexpr double kTooFast = 0.45;
constexpr int kColdFrames = 2;
constexpr double kMaxDivisor = 8.0;
constexpr double kAim = 0.9;  // of the budget, so that most frames hold it

}  // namespace

glm::ivec2 Resolution::size_in(glm::ivec2 window) const {
    return glm::max(glm::ivec2(glm::dvec2(window) / divisor_), glm::ivec2(1));
}

void Resolution::start() {
    cold_frames_ = kColdFrames;
    frames_ = 0;
}

bool Resolution::learn(double frame_s) {
    if (cold_frames_ > 0) {
        --cold_frames_;
        return false;
    }
    frames_s_[static_cast<std::size_t>(frames_)] = frame_s;
    if (++frames_ < kFrames) return false;
    frames_ = 0;
    std::ranges::sort(frames_s_);
    const double ratio = frames_s_[kFrames / 2] / budget_s_;
    const bool is_off = ratio > kTooSlow || (ratio < kTooFast && divisor_ > 1.0);
    if (!is_off) return false;
    const double wanted = std::clamp(divisor_ * std::sqrt(ratio / kAim), 1.0, kMaxDivisor);
    return std::exchange(divisor_, wanted) != wanted;
}

}  // namespace voxilux
