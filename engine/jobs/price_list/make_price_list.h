#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "jobs/price_list/price_list.h"

namespace voxilux {

// What to measure the price list of, and in which time.
struct PriceListJob {
    std::string name;  // of the scene, as the user calls it
    const Scene& scene;
    std::int64_t frame = 0;
    RenderOptions options;  // `started` is when the time begins
    double time_limit_s = 120.0;
    std::size_t repeats = 3;           // pictures of each run
    std::filesystem::path references;  // folder where converged pictures are kept; empty: nowhere
    std::function<void(const Progress&)> on_progress;
};

// Renders the configurations of the scene's plan, a reference, its effects and the rows of pictures. When it
// is interrupted, the list has what was measured until then; throws Error(interrupted) if that is too little
// for a list.
[[nodiscard]] PriceList make_price_list(const PriceListJob& job);

}  // namespace voxilux
