#pragma once

// Pictures of the same price, and pictures of the same error.

#include <string>
#include <vector>

#include "jobs/price_list/measure.h"

namespace voxilux {

// One picture of a row.
struct EqualPicture {
    std::size_t knob = 0;  // in KnobDesign::knobs
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

// The time of way 0 at `samples` samples, and a picture of every chosen way with so many samples as take that
// time. Of each knob the first and the last setting are chosen, beside way 0 itself, as far as
// Workshop::left_s allows.
[[nodiscard]] EqualRow equal_time_row(const Workshop& workshop, const KnobDesign& design,
                                      const std::vector<MeasuredWay>& ways, std::uint32_t samples);

// The same for the error of way 0. How many samples a way needs follows from its levels; none takes more than
// `most_s`.
[[nodiscard]] EqualRow equal_error_row(const Workshop& workshop, const KnobDesign& design,
                                       const std::vector<MeasuredWay>& ways, std::uint32_t samples,
                                       double most_s);

// Samples that a way is likely to need for an error, from its two last levels.
[[nodiscard]] double samples_for_error(const std::vector<Level>& levels, double error);

}  // namespace voxilux
