#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace voxilux {

struct CompareOptions {
    std::filesystem::path ref;
    std::filesystem::path test;
    std::string json;            // file for the metrics as JSON, "-" for standard output, empty for none
    std::filesystem::path mask;  // image whose black pixels are left out
    std::vector<int> box;        // x0,y0,x1,y1: columns x0..x1-1, rows y0..y1-1; empty for the whole image
    std::map<std::string, double> max;  // limits by metric: rmse, relmse, flip, mae, abs
    std::filesystem::path diff;         // picture of the difference, .exr or .png
};

// Declares the subcommand and its flags; parsing fills `options`, which must outlive the app.
CLI::App* add_compare(CLI::App& app, CompareOptions& options);

// Prints the difference of two images, one line per fact or as the JSON of the command line contract. Returns
// ExitCode::over_threshold when a limit is exceeded (a metric that cannot be computed exceeds every limit),
// else ExitCode::done. Throws Error(input_refused) for unreadable images and different sizes.
int run_compare(const CompareOptions& options);

}  // namespace voxilux
