#include "view/script_player.h"

namespace voxilux {

const ScriptAction* ScriptPlayer::next(std::int64_t shown_frames, const LivePicture& picture,
                                       bool takes_screenshot) {
    if (has_ended()) return nullptr;
    const ScriptStep& step = script_.steps[next_];
    const bool has_samples =
        !step.samples || (picture.is_loaded() && !picture.is_moving() && picture.samples() >= *step.samples);
    if (step.frame > shown_frames || !has_samples) return nullptr;
    if (takes_screenshot && !std::holds_alternative<ScreenshotAction>(step.action)) return nullptr;
    ++next_;
    return &step.action;
}

}  // namespace voxilux
