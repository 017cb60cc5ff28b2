#include "view/resolution.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace voxilux {
namespace {

// Another size costs the occlusion cells that earlier frames filled, so it has to be worth it.
constexpr double kTooSlow = 1.2;
constexpr double kTooFast = 0.5;
constexpr int kFrames = 4;  // that have to agree
constexpr double kMaxDivisor = 8.0;
constexpr double kAim = 0.8;  // of the frame time, so that most frames hold it

}  // namespace

glm::ivec2 Resolution::size_in(glm::ivec2 window) const {
    return glm::max(glm::ivec2(glm::dvec2(window) / divisor_), glm::ivec2(1));
}

bool Resolution::learn(double frame_s) {
    mean_s_ += (frame_s - mean_s_) / ++frames_;
    if (frames_ < kFrames) return false;
    const double ratio = mean_s_ / target_s_;
    const bool is_off = ratio > kTooSlow || (ratio < kTooFast && divisor_ > 1.0);
    frames_ = 0;
    mean_s_ = 0.0;
    if (!is_off) return false;
    const double wanted = std::clamp(divisor_ * std::sqrt(ratio / kAim), 1.0, kMaxDivisor);
    return std::exchange(divisor_, wanted) != wanted;
}

}  // namespace voxilux
