#pragma once

#include <array>

#include <glm/glm.hpp>

namespace voxilux {

// How coarse the picture is while it moves: as fine as the time for its samples allows.
class Resolution {
  public:
    // Sets the time that the samples of a frame may take.
    void set_budget(double seconds) { budget_s_ = seconds; }

    // The size of the picture in a window of `window` pixels.
    [[nodiscard]] glm::ivec2 size_in(glm::ivec2 window) const;

    // Called when a new plan begins: its first frames compile shaders and fill occlusion cells.
    void start();

    // Learns from the time of a frame of the current size; true when another size would fit better from now
    // on.
    bool learn(double frame_s);

  private:
    static constexpr int kFrames = 3;  // the median of these counts

    double budget_s_ = 0.033;
    double divisor_ = 4.0;  // of width and height
    int cold_frames_ = 0;   // frames left that do not count
    std::array<double, kFrames> frames_s_{};
    int frames_ = 0;
};

}  // namespace voxilux
