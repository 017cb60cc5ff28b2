#pragma once

#include "view/view_state.h"

namespace voxilux {

// Sets the samples and occlusion rays of a preset, as --quality does. Where that is not possible, sets a
// message.
void choose_quality(const QualityPreset& preset, ViewState& state);
// The preset after the chosen one; after the last, the first.
void step_quality(ViewState& state);

}  // namespace voxilux
