#pragma once

// The buffers that several passes of photons share.

#include "passes/plane.h"
#include "shared/photon_cell.h"
#include "shared/photon_types.h"

namespace voxilux {

[[nodiscard]] inline std::string photon_frame_buffer(Recording& recording) {
    return declare<gpu::PhotonParams>(recording, "photon.frame", 1);
}

[[nodiscard]] inline std::string photon_head_buffer(Recording& recording) {
    return declare<gpu::PhotonHead>(recording, "photon.head", 1);
}

[[nodiscard]] inline std::string photon_store_buffer(const RenderPlan& plan, Recording& recording) {
    return declare<gpu::StoredPhoton>(recording, "photon.stored", plan.photons.capacity);
}

[[nodiscard]] inline std::string photon_sorted_buffer(const RenderPlan& plan, Recording& recording) {
    return declare<gpu::SortedPhoton>(recording, "photon.sorted", plan.photons.capacity);
}

[[nodiscard]] inline std::string photon_wanted_buffer(const RenderPlan& plan, Recording& recording) {
    return declare<gpu::uint>(recording, "photon.wanted", gpu::mark_words(plan.photons.buckets));
}

[[nodiscard]] inline std::string photon_counts_buffer(const RenderPlan& plan, Recording& recording) {
    return declare<gpu::uint>(recording, "photon.counts", plan.photons.buckets);
}

// Where each bucket starts, and where the last one ends.
[[nodiscard]] inline std::string photon_starts_buffer(const RenderPlan& plan, Recording& recording) {
    return declare<gpu::uint>(recording, "photon.starts", std::uint64_t{plan.photons.buckets} + 1);
}

}  // namespace voxilux
