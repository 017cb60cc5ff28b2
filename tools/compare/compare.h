#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "estimators/compare_images.h"
#include "flags.h"

namespace voxilux {

struct CompareOptions {
    std::string ref;
    std::string test;
    std::string json;  // file for the metrics as JSON, "-" for standard output, empty for none
    std::string mask;  // image whose black pixels are left out
    std::optional<PixelBox> box;
    std::map<std::string, double> max;  // limits by metric: rmse, relmse, flip, mae, abs
    bool strict = false;                // different crop windows are refused
    std::string diff;                   // picture of the difference, .exr or .png
};

// The metrics of the command line contract, with exactly its keys; a number that is not finite is null.
[[nodiscard]] nlohmann::ordered_json metrics_json(const ImageComparison& comparison);

void add_compare_flags(Flags& flags, CompareOptions& options);

// Prints the difference of two images, one line per fact or as the JSON of the command line contract. Returns
// ExitCode::over_threshold when a limit is exceeded (a metric that cannot be computed exceeds every limit),
// else ExitCode::done. Throws Error(input_refused) for unreadable images and different sizes.
int run_compare(const CompareOptions& options);

}  // namespace voxilux
