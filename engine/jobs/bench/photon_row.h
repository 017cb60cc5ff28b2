#pragma once

// What `bench photons` prints.

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "jobs/bench/photon_numbers.h"
#include "jobs/bench/photon_variant.h"

namespace voxilux {

// One render. Times are those of the fastest round; counts are the same in all.
struct PhotonRow {
    std::string scene;
    std::string series;  // "options", or the quantity that grows: "photons", "size", "iterations"
    PhotonVariant variant;
    std::uint32_t photons = 0;  // emitted in an iteration
    glm::ivec2 size{0};
    std::uint32_t iterations = 0;
    double radius = 0.0;  // of the first iteration, voxels
    double alpha = 0.0;
    double wall_s = 0.0;                      // from the plan to the image
    double cpu_s = 0.0;                       // all threads
    std::map<std::string, double> passes_ms;  // per iteration
    std::uint64_t stored = 0;                 // photons, over all iterations
    std::uint64_t segments = 0;               // of photon paths, and shadow rays
    std::uint64_t faults = 0;  // of all kinds: photons that do not fit, paths cut off and so on
    std::optional<PhotonErrors> errors;

    [[nodiscard]] double photons_per_s() const;  // per second of wall time
};

// How the work of a series grows with the quantity that is varied.
struct PhotonGrowth {
    std::string scene;
    std::string series;
    std::optional<double> wall;            // exponent of the wall time
    std::map<std::string, double> passes;  // of each pass's time over all iterations
};

// The exponents of the rows of one series, which differ in one quantity only. "size" counts pixels.
[[nodiscard]] PhotonGrowth growth_of(std::span<const PhotonRow> rows);

[[nodiscard]] nlohmann::ordered_json to_json(const PhotonRow& row);
[[nodiscard]] nlohmann::ordered_json to_json(const PhotonGrowth& growth);

// The rows of one series as a table, and the exponents below it.
[[nodiscard]] std::string describe(std::span<const PhotonRow> rows);

}  // namespace voxilux
