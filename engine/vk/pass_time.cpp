#include "vk/pass_time.h"

#include <algorithm>

namespace voxilux {

void add_times(std::vector<PassTime>& sum, std::span<const PassTime> more) {
    for (const PassTime& pass : more) {
        auto known = std::ranges::find(sum, pass.label, &PassTime::label);
        if (known == sum.end()) known = sum.insert(known, PassTime{.label = pass.label});
        known->count += pass.count;
        known->ms += pass.ms;
        known->max_ms = std::max(known->max_ms, pass.max_ms);
    }
}

}  // namespace voxilux
