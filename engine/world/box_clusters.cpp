#include "world/box_clusters.h"

#include <algorithm>
#include <iterator>

#include "base/assert.h"
#include "base/checked_cast.h"

namespace voxilux {
namespace {

void merge(RoundedBox& into, const RoundedBox& box) {
    into.low = glm::min(into.low, box.low);
    into.high = glm::max(into.high, box.high);
    into.radius = std::max(into.radius, box.radius);
}

}  // namespace

BoxClusters::Key BoxClusters::key_of(std::uint32_t kind, glm::ivec3 place) const {
    return {static_cast<int>(kind), place.x >> shift_, place.y >> shift_, place.z >> shift_};
}

void BoxClusters::add(std::uint32_t kind, glm::ivec3 place, const RoundedBox& box) {
    const auto [found, is_new] = boxes_.try_emplace(key_of(kind, place), box);
    if (!is_new) merge(found->second, box);
    while (boxes_.size() > most_)
        coarsen();
}

void BoxClusters::coarsen() {
    ++shift_;
    VX_ASSERT(shift_ < 32);
    std::map<Key, RoundedBox> coarse;
    for (const auto& [key, box] : boxes_) {
        const auto [found, is_new] = coarse.try_emplace({key[0], key[1] >> 1, key[2] >> 1, key[3] >> 1}, box);
        if (!is_new) merge(found->second, box);
    }
    boxes_ = std::move(coarse);
}

std::vector<BoxClusters::Cluster> BoxClusters::clusters() const {
    std::vector<Cluster> all;
    all.reserve(boxes_.size());
    for (const auto& [key, box] : boxes_)
        all.push_back({static_cast<std::uint32_t>(key[0]), box});
    return all;
}

std::uint32_t BoxClusters::number_of(std::uint32_t kind, glm::ivec3 place) const {
    const auto found = boxes_.find(key_of(kind, place));
    VX_ASSERT(found != boxes_.end());
    return checked_cast<std::uint32_t>(std::distance(boxes_.begin(), found), "cluster");
}

}  // namespace voxilux
