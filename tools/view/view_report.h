#pragma once

#include <string>
#include <vector>

#include "view/view_state.h"

namespace voxilux {

// The contents of --report: a row for each frame that was shown, and what was shown last.
class ViewReport {
  public:
    // Called when samples were taken and the turn of the loop goes on.
    void add_step(const LiveFrame& frame) {
        last_ = frame;
        step_s_ += frame.step_s;
        add_step_times(built_, frame.built);
    }
    // Sets the seconds from the start to the first shown frame.
    void set_first(double seconds) { first_s_ = seconds; }
    // Called when a frame was shown, `seconds` after the one before; showing it took `show_s`.
    void add_frame(double seconds, double show_s);
    void write(const std::string& file, const ViewState& state, glm::ivec2 window,
               const std::vector<std::string>& messages) const;

  private:
    // Times of a shown frame are in milliseconds. Kept as JSON, thousands of frames would use the memory that
    // they are meant to watch.
    struct Frame {
        double ms = 0.0;
        double step_ms = 0.0;
        double show_ms = 0.0;
        double resident_mib = 0.0;
        std::uint32_t samples = 0;
        glm::ivec2 size{0};
        std::vector<StepTime> built{};
    };

    std::vector<Frame> frames_;
    LiveFrame last_;
    double step_s_ = 0.0;  // since the last frame
    std::vector<StepTime> built_;
    double first_s_ = 0.0;
};

}  // namespace voxilux
