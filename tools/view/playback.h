#pragma once

#include <cstdint>
#include <optional>

#include "scene/animation.h"
#include "view/view_state.h"

namespace voxilux {

// Shows the frames of an animated scene.
class Playback {
  public:
    // Another scene, which shows `frame`. A still one has no frames.
    void load(const Scene& scene, std::int64_t frame, ViewState& state);

    // Goes on by so many seconds while the state says that it plays, and shows the state's frame.
    void advance(double seconds, ViewState& state);

  private:
    std::optional<FramePlayer> player_;
    std::int64_t shown_ = 0;
    double left_s_ = 0.0;  // until the next frame
};

}  // namespace voxilux
