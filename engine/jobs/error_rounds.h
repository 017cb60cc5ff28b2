#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "estimators/error_curve.h"

namespace voxilux {

// What decided the number of samples of an image.
enum class DecidedBy : std::uint8_t {
    request,       // the user's number, time limit or interruption
    pilot,         // samples that are not part of the image
    frame_before,  // the samples of another frame
    averaged       // the image's own samples: their noise showed whether it was good enough
};

[[nodiscard]] std::string_view name_of(DecidedBy decided_by);

// What is known of an image before its first sample.
struct ErrorPrior {
    std::vector<ErrorPoint> points;
    DecidedBy from = DecidedBy::pilot;
};

// The stop rule of a render with an error target: rounds of samples, sized beforehand, whose error is
// estimated only at the end of a round. Stopping when one's own noise happens to be low makes estimates too
// low; here one look decides in most renders, and the number of looks is reported.
class ErrorRounds {
  public:
    // `most`: samples that the render may take. `done`: samples that its film already has.
    ErrorRounds(const ErrorLaw& law, double target, const ErrorPrior& guess, std::uint32_t most,
                std::uint32_t done);

    // Sample count at which the round ends.
    [[nodiscard]] std::uint32_t end() const { return end_; }
    [[nodiscard]] std::uint32_t rounds() const { return rounds_; }
    [[nodiscard]] DecidedBy decided_by() const { return decided_by_; }

    // The error estimate at the end of a round: true when it reaches the target; otherwise another round
    // begins.
    bool reaches(std::uint32_t samples, const ErrorEstimate& claim);

  private:
    ErrorLaw law_;
    double target_;
    std::uint32_t most_;
    std::vector<ErrorPoint> points_;
    std::uint32_t end_ = 0;
    std::uint32_t rounds_ = 1;
    DecidedBy decided_by_;
};

}  // namespace voxilux
