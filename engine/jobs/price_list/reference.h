#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "jobs/price_list/error_split.h"
#include "jobs/price_list/parameters.h"
#include "jobs/render_session.h"

namespace voxilux {

// The converged picture that all others are compared with.
struct Reference {
    Image image;
    std::uint32_t samples = 0;
    double time_s = 0.0;  // on the device
    bool is_cached = false;
    ErrorEstimate error;  // its own
    nlohmann::ordered_json settings;

    // Of the error, noise alone. Its bias, where it can be told, is in `error`, too.
    [[nodiscard]] ReferenceNoise noise() const;
};

struct ReferenceJob {
    std::int64_t frame = 0;
    Configuration base;
    std::filesystem::path cache;    // folder; empty: none
    std::uint32_t max_samples = 0;  // that are of use
    double budget_s = 0.0;          // of device time
};

// A picture by the settings with the least bias (brute-force occlusion, narrow discs of photons) and random
// numbers of its own, in two independent halves whose difference tells its noise. A cached one is taken when
// it has at least half of the samples that would be taken now.
[[nodiscard]] Reference make_reference(RenderSession& session, const ReferenceJob& job);

// The settings of a reference of a scene that is rendered as `base` says, which `plan` is of.
[[nodiscard]] RenderSettings reference_settings(const Configuration& base, const RenderPlan& plan);

}  // namespace voxilux
