#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "estimators/error_curve.h"

namespace voxilux {

// What the number of samples of a picture was decided by.
enum class DecidedBy : std::uint8_t {
    request,       // the user's number, time limit or interruption
    pilot,         // samples that the picture does not have
    frame_before,  // those of another frame
    averaged       // its own: it was found to be good enough, or not, by the noise that it has
};

[[nodiscard]] std::string_view name_of(DecidedBy decided_by);

// What is known of a picture before its first sample.
struct ErrorPrior {
    std::vector<ErrorPoint> points;
    DecidedBy from = DecidedBy::pilot;
};

// The stop rule of a render with an error target: rounds of samples, sized beforehand. Only at the end of a
// round is its claim looked at. Stopping when one's own noise happens to be low makes claims too low; here
// one look decides in most renders, and how many there were is reported.
class ErrorRounds {
  public:
    // `most`: samples that the render may take. `done`: that its film has already.
    ErrorRounds(const ErrorLaw& law, double target, const ErrorPrior& guess, std::uint32_t most,
                std::uint32_t done);

    // Samples at which the round ends.
    [[nodiscard]] std::uint32_t end() const { return end_; }
    [[nodiscard]] std::uint32_t rounds() const { return rounds_; }
    [[nodiscard]] DecidedBy decided_by() const { return decided_by_; }

    // The claim at the end of a round: true when it reaches the target, else there is another round.
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
