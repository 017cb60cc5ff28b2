#pragma once

#include "view/live_picture.h"
#include "view/script.h"

namespace voxilux {

// A script and how far it has been played.
class ScriptPlayer {
  public:
    explicit ScriptPlayer(ViewScript script) : script_(std::move(script)) {}

    [[nodiscard]] bool is_empty() const { return script_.steps.empty(); }
    [[nodiscard]] bool has_ended() const { return next_ == script_.steps.size(); }

    // The next action that is due after so many shown frames; null where there is none. While a screenshot of
    // this frame is still to be taken, only further screenshots are due.
    [[nodiscard]] const ScriptAction* next(std::int64_t shown_frames, const LivePicture& picture,
                                           bool takes_screenshot);

    // The number of samples that the script waits for: the film must not grow beyond it.
    [[nodiscard]] std::uint32_t awaited_samples() const {
        return has_ended() ? kNoEnd : script_.steps[next_].samples.value_or(kNoEnd);
    }

  private:
    ViewScript script_;
    std::size_t next_ = 0;
};

}  // namespace voxilux
