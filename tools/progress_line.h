#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "jobs/render_session.h"

namespace voxilux {

// What --progress says: one line that is overwritten if standard error is a terminal, nothing, or one JSON
// object per line.
enum class ProgressMode : std::uint8_t { automatic, never, json };

// Progress on standard error. The destructor clears the line, so that whatever follows starts on an empty
// one.
class ProgressLine {
  public:
    // A quiet one shows JSON alone.
    ProgressLine(ProgressMode mode, bool quiet);
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    ~ProgressLine() { finish(); }

    // What a render calls; empty when nothing is shown. Must not outlive this.
    [[nodiscard]] std::function<void(const Progress&)> callback();

    // Shows text(as_json) unless the last one was shown just now. `done` is in [0, 1].
    void show(double done, double elapsed_s, const std::function<std::string(bool as_json)>& text);

    void finish();

  private:
    enum class Form : std::uint8_t { nothing, line, json };
    Form form_ = Form::nothing;
    bool is_shown_ = false;
    double last_s_ = -1.0;
};

// The line for people, without control characters: "frame 3 of 12 42.0 %  sample 7  12 s, 15 to 19 s left
// error 2.1 %, 1 % at the end".
[[nodiscard]] std::string progress_text(const Progress& progress);

// The object for programs, on one line: done, sample, elapsed_s, remaining_s, remaining_low_s,
// remaining_high_s; the frame and their number in a frame range; error and error_at_end once they are known.
[[nodiscard]] std::string progress_json(const Progress& progress);

}  // namespace voxilux
