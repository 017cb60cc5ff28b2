#pragma once

// What `bench ao` prints.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace voxilux {

struct AoPassTime {
    std::string label;
    double ms = 0.0;  // per frame
};

struct AoError {
    int frame = 0;  // from 1
    double rmse = 0.0;
};

// One variant on one motion of one scene. Counts and times are per frame.
struct AoRow {
    std::string scene;
    std::string motion;
    std::string variant;
    int frames = 0;
    std::uint32_t rays_per_pixel = 1;
    std::vector<AoPassTime> passes;  // those of occlusion
    double cpu_ms = 0.0;             // all threads, for the whole frame
    double rays = 0.0;               // occlusion rays
    double searched_percent = 0.0;   // of the hits
    double probes_per_search = 0.0;
    double atomics = 0.0;
    double table_full = 0.0;        // hits without a slot
    std::uint64_t cells = 0;        // live ones at the end
    double load = 0.0;              // fraction of slots in use
    std::vector<AoError> errors;    // against the reference, over pixels that show voxels
    double reference_noise = 0.0;   // bound of the reference's own error
    std::optional<double> flicker;  // mean change of visibility from the last frame but one to the last

    [[nodiscard]] double ao_ms() const;  // sum over its passes
};

[[nodiscard]] nlohmann::ordered_json to_json(const AoRow& row);

// The rows of one scene as a table for each motion.
[[nodiscard]] std::string describe(std::span<const AoRow> rows);

}  // namespace voxilux
