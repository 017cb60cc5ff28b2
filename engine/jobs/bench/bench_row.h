#pragma once

// What a benchmark of rays prints.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>

namespace voxilux {

// The rays of one kind through one structure of one scene. The numbers after `reason` are meaningless when
// the structure does not fit the device.
struct BenchRow {
    std::string scene;
    int extent = 0;  // longest axis of the world, voxels
    std::string traversal;
    std::string rays;    // kind
    std::string reason;  // why it did not run; empty when it did
    std::uint64_t count = 0;
    double mrays_per_cpu_s = 0.0;  // best round; CPU seconds of all threads
    double mrays_per_s = 0.0;      // best round; wall seconds
    double steps = 0.0;            // mean
    std::uint64_t memory_bytes = 0;
    std::optional<double> build_s;         // CPU seconds of one thread that builds the structure
    std::optional<double> device_build_s;  // wall seconds of a build on the device
    std::uint64_t checked = 0;
    std::uint64_t mismatches = 0;  // of the checked rays
};

[[nodiscard]] nlohmann::ordered_json to_json(const BenchRow& row);

// The traversal that others are compared with: the paper's.
inline constexpr const char* kBaseline = "naadf";

// The rows of one scene as a table with a line per traversal and the kinds of rays side by side, followed by
// the geometric mean of the rates relative to kBaseline.
[[nodiscard]] std::string describe(std::span<const BenchRow> rows);

}  // namespace voxilux
