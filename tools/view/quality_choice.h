#pragma once

#include "view/view_state.h"

namespace voxilux {

// The samples and occlusion rays of a preset, as --quality sets them. What cannot be is said.
void choose_quality(const QualityPreset& preset, ViewState& state);
// The preset after the chosen one; the first one after the last.
void step_quality(ViewState& state);

}  // namespace voxilux
