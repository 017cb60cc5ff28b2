#pragma once

#include <span>

#include "formats/image.h"

namespace voxilux {

// The systematic part of a difference between images, in the units of relMSE: mean over pixels and channels
// of difference^2 / (radiance^2 + kRelMseEpsilon).
struct SquareEstimate {
    double squared = 0.0;  // without bias, so that noise may make it negative
    double low = 0.0;      // interval of 95 %
    double high = 0.0;

    // Lower end of the interval where no pixel counts for more than a difference of 100 %. It still shows a
    // difference where the noise of a few bright pixels would otherwise hide it.
    double bounded_low = 0.0;

    // Whether noise alone would hardly give so much.
    [[nodiscard]] bool is_beyond_noise() const { return low > 0.0 || bounded_low > 0.0; }
};

// One measurement of a difference: `test` - `base`. Not owned.
struct DifferenceTrial {
    const Image* test = nullptr;
    const Image* base = nullptr;
};

inline constexpr std::size_t kMinTrials = 3;

// From kMinTrials or more trials with independent random numbers; the two images of a trial may share theirs.
// The mean product of the differences of two trials is free of the noise of either (difference_estimate.cpp).
// Radiance is that of `radiance`, or, for null, that of the bases of the other trials. Images have one size
// and colours (asserted).
[[nodiscard]] SquareEstimate estimate_difference(std::span<const DifferenceTrial> trials,
                                                 const Image* radiance = nullptr);

}  // namespace voxilux
