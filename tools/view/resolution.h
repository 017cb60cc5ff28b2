#pragma once

#include <glm/glm.hpp>

namespace voxilux {

// How coarse the picture is while it moves: as fine as the frame time allows.
class Resolution {
  public:
    void set_target(double seconds) { target_s_ = seconds; }
    [[nodiscard]] double target() const { return target_s_; }

    // The size of the picture in a window of so many pixels.
    [[nodiscard]] glm::ivec2 size_in(glm::ivec2 window) const;

    // Learns from a frame of that size; true when another size would do better from now on.
    bool learn(double frame_s);

  private:
    double target_s_ = 0.033;
    double divisor_ = 2.0;  // of width and height
    double mean_s_ = 0.0;   // of the last frames at this size
    int frames_ = 0;
};

}  // namespace voxilux
