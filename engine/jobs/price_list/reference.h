#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "jobs/price_list/error_split.h"
#include "jobs/price_list/parameters.h"
#include "jobs/render_session.h"

namespace voxilux {

// The converged image that all others are compared with.
struct Reference {
    Image image;
    std::uint32_t samples = 0;
    double time_s = 0.0;  // device time
    bool is_cached = false;
    ErrorEstimate error;  // its own estimate
    nlohmann::ordered_json settings;

    // The noise part of the error. Its bias, where known, is also in `error`.
    [[nodiscard]] ReferenceNoise noise() const;
};

struct ReferenceJob {
    std::int64_t frame = 0;
    Configuration base;
    std::filesystem::path cache;    // folder; empty: none
    std::uint32_t max_samples = 0;  // more are of no use
    double budget_s = 0.0;          // device time
};

// An image with the least biased settings (brute-force occlusion, narrow photon kernels) and random numbers
// of its own, in two independent halves whose difference gives its noise. A cached one is used when it has at
// least half of the samples that would be taken now.
[[nodiscard]] Reference make_reference(RenderSession& session, const ReferenceJob& job);

// The settings of the reference for a scene rendered as in `base`; `plan` is that of `base`.
[[nodiscard]] RenderSettings reference_settings(const Configuration& base, const RenderPlan& plan);

}  // namespace voxilux
