#pragma once

#include "view/view_state.h"

namespace voxilux {

[[nodiscard]] constexpr std::string_view name_of(DisplayChannel channel) {
    return kDisplayChannelNames[static_cast<std::size_t>(channel)];
}

// Shows a channel of the film. Adds it to the film if it is missing.
void show_channel(DisplayChannel channel, ViewState& state);
// Shows the next channel, or the one before.
void step_channel(int step, ViewState& state);

// Changes the exposure by so many stops.
void expose(float stops, ViewState& state);

// Sets the range of the false colours, which depends on the camera.
void fit_range(ViewState& state);

// Reads the pixel under the pointer, while a panel shows it.
void read_pixel(ViewState& state);

// Whether the divider is in the picture.
[[nodiscard]] bool is_wiping(const ViewState& state);
// Makes an image the reference and returns its size. Throws Error(input_refused) for one without colours.
glm::ivec2 compare_with(const std::string& file, ViewState& state);
// Goes through: no comparison, the reference, the difference from it, FLIP.
void step_comparison(ViewState& state);

}  // namespace voxilux
