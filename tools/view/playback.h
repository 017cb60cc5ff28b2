#pragma once

#include <cstdint>
#include <optional>

#include "scene/animation.h"
#include "view/view_state.h"

namespace voxilux {

// Shows the frames of an animated scene.
class Playback {
  public:
    // Loads another scene and returns it as it is at `frame`; the result is valid until the next call. A
    // still scene has no frames.
    const Scene& load(const Scene& scene, std::int64_t frame);

    // Sets the frames in the state. The frame of load() is the one shown.
    void start(ViewState& state) const;

    // Moves on by so many seconds while the state says that it plays, and shows the state's frame.
    void advance(double seconds, ViewState& state);

  private:
    void show(std::int64_t frame, ViewState& state);

    std::optional<FramePlayer> player_;
    std::optional<FrameRange> frames_;
    bool moves_camera_ = false;
    bool turns_sun_ = false;
    std::int64_t shown_ = 0;
    double left_s_ = 0.0;  // until the next frame
};

}  // namespace voxilux
