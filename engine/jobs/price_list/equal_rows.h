#pragma once

// Images of equal time, and images of equal error.

#include <string>
#include <vector>

#include "jobs/price_list/measure.h"

namespace voxilux {

// One image of a row.
struct EqualPicture {
    std::size_t parameter = 0;  // in ParameterDesign::parameters
    std::size_t setting = 0;
    std::uint32_t samples = 0;
    double time_s = 0.0;
    double error = 0.0;
    bool is_reached = true;  // whether it meets the row's time or error
    Image picture;
};

struct EqualRow {
    double target = 0.0;  // seconds, or an error
    std::vector<EqualPicture> pictures;
};

// The time of configuration 0 at `samples` samples, and an image of every chosen configuration with as many
// samples as take that time. Besides configuration 0, the first and the last setting of each parameter are
// chosen, as far as Workshop::left_s allows.
[[nodiscard]] EqualRow equal_time_row(const Workshop& workshop, const ParameterDesign& design,
                                      const std::vector<MeasuredConfiguration>& configurations,
                                      std::uint32_t samples);

// The same for the error of configuration 0. How many samples a configuration needs follows from its levels;
// none takes longer than `max_s`.
[[nodiscard]] EqualRow equal_error_row(const Workshop& workshop, const ParameterDesign& design,
                                       const std::vector<MeasuredConfiguration>& configurations,
                                       std::uint32_t samples, double max_s);

// Samples that a configuration probably needs for an error, extrapolated from its last two levels.
[[nodiscard]] double samples_for_error(const std::vector<Level>& levels, double error);

}  // namespace voxilux
