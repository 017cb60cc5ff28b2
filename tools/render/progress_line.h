#pragma once

#include <functional>
#include <string>

#include "jobs/render_session.h"

namespace voxilux {

// Progress on standard error: one line that is overwritten ("auto" on a terminal), one JSON object per line
// ("json"), or nothing ("never", and "auto" when standard error is piped). The line is gone when this ends,
// so that whatever follows starts on a clean one.
class ProgressLine {
  public:
    // Throws Error(usage) for another word.
    ProgressLine(const std::string& mode, bool quiet);
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    ~ProgressLine() { finish(); }

    // What render_scene calls; empty when nothing is shown. Must not outlive this.
    [[nodiscard]] std::function<void(const Progress&)> callback();

    void finish();

  private:
    void show(const Progress& progress);

    enum class Mode { nothing, line, json };
    Mode mode_ = Mode::nothing;
    bool is_shown_ = false;
    double last_s_ = -1.0;
};

// The line for people, without control characters: "frame 3 of 12 42.0 %  sample 7  12 s, 15 to 19 s left
// error 2.1 %, 1 % at the end".
[[nodiscard]] std::string progress_text(const Progress& progress);

// The object for programs, on one line: done, sample, elapsed_s, remaining_s, remaining_low_s,
// remaining_high_s, of a frame range which frame of how many frames, and error and error_at_end once they
// are known.
[[nodiscard]] std::string progress_json(const Progress& progress);

}  // namespace voxilux
