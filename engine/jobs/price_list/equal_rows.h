#pragma once

// Pictures of the same price, and pictures of the same error.

#include <string>
#include <vector>

#include "jobs/price_list/measure.h"

namespace voxilux {

// One picture of a row.
struct EqualPicture {
    std::size_t parameter = 0;  // in ParameterDesign::parameters
    std::size_t setting = 0;
    std::uint32_t samples = 0;
    double time_s = 0.0;
    double error = 0.0;
    bool is_reached = true;  // the row's time or error
    Image picture;
};

struct EqualRow {
    double target = 0.0;  // seconds, or an error
    std::vector<EqualPicture> pictures;
};

// The time of configuration 0 at `samples` samples, and a picture of every chosen configuration with so many
// samples as take that time. Of each parameter the first and the last setting are chosen, beside
// configuration 0 itself, as far as Workshop::left_s allows.
[[nodiscard]] EqualRow equal_time_row(const Workshop& workshop, const ParameterDesign& design,
                                      const std::vector<MeasuredConfiguration>& configurations,
                                      std::uint32_t samples);

// The same for the error of configuration 0. How many samples a configuration needs follows from its levels;
// none takes more than `max_s`.
[[nodiscard]] EqualRow equal_error_row(const Workshop& workshop, const ParameterDesign& design,
                                       const std::vector<MeasuredConfiguration>& configurations,
                                       std::uint32_t samples, double max_s);

// Samples that a configuration is likely to need for an error, from its two last levels.
[[nodiscard]] double samples_for_error(const std::vector<Level>& levels, double error);

}  // namespace voxilux
