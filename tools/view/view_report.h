#pragma once

#include <string>
#include <vector>

#include "view/view_state.h"

namespace voxilux {

// What --report tells: a row for each frame that was shown, and what was shown last.
class ViewReport {
  public:
    // A turn of the loop took samples and is not over.
    void add_step(const LiveFrame& frame) {
        last_ = frame;
        step_s_ += frame.step_s;
    }
    // The first frame was shown so long after the start.
    void set_first(double seconds) { first_s_ = seconds; }
    // A frame was shown, `seconds` after the one before; showing it took `show_s`.
    void add_frame(double seconds, double show_s);
    void write(const std::string& file, const ViewState& state, glm::ivec2 window,
               const std::vector<std::string>& messages) const;

  private:
    // Of a frame that was shown; times in milliseconds. As JSON, thousands of them would take the memory that
    // they are to watch.
    struct Frame {
        double ms = 0.0;
        double step_ms = 0.0;
        double show_ms = 0.0;
        double resident_mib = 0.0;
        std::uint32_t samples = 0;
        glm::ivec2 size{0};
    };

    std::vector<Frame> frames_;
    LiveFrame last_;
    double step_s_ = 0.0;  // since the last frame
    double first_s_ = 0.0;
};

}  // namespace voxilux
