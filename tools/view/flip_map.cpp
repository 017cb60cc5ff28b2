#include "view/flip_map.h"

#include <chrono>
#include <numeric>

namespace voxilux {

void FlipMap::start(const Image& reference, Image test, std::uint32_t samples) {
    started_ = samples;
    is_stale_ = false;
    pending_ =
        std::async(std::launch::async, [reference, test = std::move(test)] { return flip(reference, test); });
}

bool FlipMap::collect(bool waits) {
    if (!pending_.valid()) return false;
    if (!waits && pending_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    std::optional<FlipResult> result = pending_.get();
    if (is_stale_) return false;
    result_ = std::move(result);
    if (result_)
        mean_ = std::accumulate(result_->error.begin(), result_->error.end(), 0.0) /
                static_cast<double>(result_->error.size());
    return true;
}

void FlipMap::clear() {
    is_stale_ = true;
    result_.reset();
    started_ = 0;
}

}  // namespace voxilux
