#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "jobs/price_list/price_list.h"

namespace voxilux {

// The scene whose price list is measured, and the time for it.
struct PriceListJob {
    std::string name;  // of the scene, as the user gave it
    const Scene& scene;
    std::int64_t frame = 0;
    RenderOptions options;  // time counts from `started`
    double time_limit_s = 120.0;
    std::size_t repeats = 3;           // images of each run
    std::filesystem::path references;  // folder that keeps converged images; empty: none
    std::function<void(const Progress&)> on_progress;
};

// Renders the configurations of the scene's plan, a reference, its effects and the rows of images. When
// interrupted, the list holds what was measured until then; throws Error(interrupted) when that is too little
// for a list.
[[nodiscard]] PriceList make_price_list(const PriceListJob& job);

}  // namespace voxilux
