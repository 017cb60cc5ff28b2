#pragma once

// What was measured, and its evaluation.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "jobs/effect_price.h"
#include "jobs/price_list/equal_rows.h"
#include "jobs/price_list/measure.h"
#include "jobs/price_list/reference.h"
#include "jobs/price_list/slope.h"

namespace voxilux {

// All measurements.
struct PriceList {
    std::string scene;  // as named on the command line
    std::uint64_t scene_hash = 0;
    std::uint32_t seed = 0;
    DeviceInfo device;
    std::size_t repeats = 0;
    double wall_s = 0.0;
    Reference reference;
    ParameterDesign design;
    std::vector<MeasuredConfiguration> configurations;
    std::uint32_t asked = 0;  // samples per pixel
    std::uint32_t top = 0;    // at which most configurations are compared; below `asked` where time was short
    std::vector<EffectPrice> effects;
    EqualRow equal_time;
    EqualRow equal_error;
};

// One point of the price list: a setting of a parameter at a number of samples.
struct PricedRun {
    std::string id;
    std::size_t parameter = 0;  // in the design
    std::string setting;
    std::size_t configuration = 0;
    std::size_t level = 0;  // of the configuration
    bool is_default = false;
};

// The runs in the order of the parameters, each parameter's cheapest first: for the parameter `samples` every
// level of configuration 0, for other settings the level with `top` samples or the last one.
[[nodiscard]] std::vector<PricedRun> list_runs(const PriceList& list);

// The exponent of error against time over the images of a configuration that the reference is precise enough
// for.
[[nodiscard]] std::optional<Slope> slope_of(const MeasuredConfiguration& configuration);

// The exponent of error against samples, which does not depend on the machine.
[[nodiscard]] std::optional<Slope> slope_of_samples(const MeasuredConfiguration& configuration);

// A header line, then a line for each configuration and number of samples.
[[nodiscard]] std::string to_csv(const PriceList& list);

// The whole list as JSON, with images named as in write_price_list.
[[nodiscard]] nlohmann::ordered_json to_json(const PriceList& list);

// Writes tradeoff.json, tradeoff.csv and the images into an existing folder, with a folder `pictures` in it;
// each file appears complete or not at all. Throws Error(cannot_write).
void write_price_list(const PriceList& list, const std::filesystem::path& folder);

// A summary for people: parameters with slopes, and the Pareto front.
[[nodiscard]] std::string describe(const PriceList& list);

// The runs that none beats in both time and error, fastest first.
[[nodiscard]] std::vector<PricedRun> front_of(const PriceList& list, const std::vector<PricedRun>& runs);

[[nodiscard]] const Level& level_of(const PriceList& list, const PricedRun& run);

// The run that an image of a row varies; the first image of a row is that of configuration 0.
[[nodiscard]] const PricedRun& run_of(const PriceList& list, const std::vector<PricedRun>& runs,
                                      const EqualPicture& picture, bool is_first);

// Image files below the folder of a price list: of a run, of a row's image, and of a difference map.
[[nodiscard]] std::string picture_of_run(const PricedRun& run);
[[nodiscard]] std::string file_of_row(const char* row, const std::string& id);
[[nodiscard]] std::string difference_of(std::string picture);

}  // namespace voxilux
