#pragma once

#include "view/view_state.h"

namespace voxilux {

[[nodiscard]] constexpr std::string_view name_of(DisplayChannel channel) {
    return kDisplayChannelNames[static_cast<std::size_t>(channel)];
}

// Shows another channel of the film, which gets it if it lacks it.
void show_channel(DisplayChannel channel, ViewState& state);
// The channel after it, or before.
void step_channel(int step, ViewState& state);

// Stops of exposure.
void expose(float stops, ViewState& state);

// The ends of false colours, which depend on the camera.
void fit_range(ViewState& state);

// Reads out what is under the pointer, where a panel shows it.
void read_pixel(ViewState& state);

// Whether the divider is in the picture.
[[nodiscard]] bool is_wiping(const ViewState& state);
// Makes an image the reference and returns its size. Throws Error(input_refused) for one without colours.
glm::ivec2 compare_with(const std::string& file, ViewState& state);
// Nothing, the reference, the difference from it, FLIP.
void step_comparison(ViewState& state);

}  // namespace voxilux
