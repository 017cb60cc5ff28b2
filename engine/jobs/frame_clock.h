#pragma once

#include <chrono>
#include <cstdint>

#include "base/clock.h"
#include "renderer/film_steps.h"

namespace voxilux {

// How fast a frame is rendered. Seconds count from the start of the frame.
class FrameClock {
  public:
    // `rows`: of the image.
    FrameClock(std::chrono::steady_clock::time_point start, FilmPosition film, std::uint32_t rows)
        : start_(start), rows_(rows), first_samples_(samples_at(film)) {}

    [[nodiscard]] double now_s() const { return seconds_since(start_); }

    void begin_sampling() { sampling_from_s_ = now_s(); }
    void end_slice(double begin_s, std::uint32_t rows) { row_s_ = (now_s() - begin_s) / rows; }
    void end_sample(double begin_s) {
        const double seconds = now_s() - begin_s;
        recent_s_ = recent_s_ > 0.0 ? recent_s_ + (seconds - recent_s_) * kRecentShare : seconds;
    }

    // Seconds per row of the last tile.
    [[nodiscard]] double row_s() const { return row_s_; }
    // Seconds per sample, averaged over the last ones; 0: unknown.
    [[nodiscard]] double recent_s() const { return recent_s_; }
    [[nodiscard]] double sampling_s() const { return now_s() - sampling_from_s_; }
    // Samples so far, the fraction of the current one included, now and when the frame began.
    [[nodiscard]] double samples_at(FilmPosition film) const {
        return film.samples + static_cast<double>(film.rows_ahead) / rows_;
    }
    [[nodiscard]] double first_samples() const { return first_samples_; }

  private:
    static constexpr double kRecentShare = 0.1;  // weight of a new sample in the recent mean

    std::chrono::steady_clock::time_point start_;
    std::uint32_t rows_;
    double first_samples_;
    double sampling_from_s_ = 0.0;
    double row_s_ = 0.0;
    double recent_s_ = 0.0;
};

}  // namespace voxilux
