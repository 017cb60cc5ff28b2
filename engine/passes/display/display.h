#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "film/tonemap.h"
#include "plan/render_plan.h"
#include "record/recording.h"
#include "shared/gpu_types.h"

namespace voxilux {

// What a display can show of a film. `error` is the standard error of the luminance, as in film_image().
// The last two are not part of the film: `cells` shows how many occlusion rays each occlusion cell of the
// last sample holds, and `steps` what a pixel costs, as the steps that its camera ray and its shadow ray
// take.
enum class DisplayChannel : std::uint8_t {
    color,
    albedo,
    normal,
    position,
    depth,
    ao,
    sun,
    error,
    cells,
    steps
};
inline constexpr std::array<std::string_view, 10> kDisplayChannelNames{
    "color", "albedo", "normal", "position", "depth", "ao", "sun", "error", "cells", "steps"};

// What is shown to the right of the divider. `map` shows numbers from 0 to 1 in place of the reference.
enum class DisplayComparison : std::uint8_t { none, reference, difference, map };

// How a film is shown.
struct DisplayLook {
    DisplayChannel channel = DisplayChannel::color;
    float exposure = 1.0f;  // multiplies `color`
    ToneMap curve = ToneMap::filmic;
    glm::vec3 low{0.0f};   // where false colours begin; of scalar channels the first component
    glm::vec3 high{1.0f};  // where they end; for the last three channels both are logarithms to base 10
    DisplayComparison comparison = DisplayComparison::none;  // of `color`, against a reference
    std::uint32_t divider = 0;                               // first column that is compared
    bool is_bgr = false;                                     // the lowest byte of a code is blue, not red

    bool operator==(const DisplayLook&) const = default;
};

// How many samples the rows of a film have.
struct SampleCounts {
    std::uint32_t samples = 0;     // of all rows
    std::uint32_t rows_ahead = 0;  // rows from the top that have one sample more
};

// An image on the device: [height][width] words of four 8-bit sRGB codes.
struct DisplayBuffer {
    std::string buffer;
    glm::ivec2 size{0};  // pixels
};

// Whether a plan has the channel.
[[nodiscard]] bool has_channel(const RenderPlan& plan, DisplayChannel channel);

// The film as codes, for whatever presents it on the device. Pixels without a sample are black. It is
// recorded only where a display is asked for and is not part of a frame. A comparison needs
// record_display_reference() in this recording or an earlier one.
DisplayBuffer record_display_resolve(const RenderPlan& plan, const SampleCounts& counts,
                                     const DisplayLook& look, Recording& recording);

// The occlusion cells as codes, black where a pixel has none. `sample` is the last one that the plan took,
// counted from 0 since its cells were emptied.
DisplayBuffer record_display_cells(const RenderPlan& plan, std::uint64_t sample, const DisplayLook& look,
                                   Recording& recording);

// The steps through the structure as codes. They are counted now, with rays of the first sample of the frame
// with these parameters.
DisplayBuffer record_display_steps(const RenderPlan& plan, gpu::FrameParams params, const DisplayLook& look,
                                   Recording& recording);

// Uploads the reference: [height][width][3] radiance in the size of the image, or the number of a map three
// times.
void record_display_reference(const RenderPlan& plan, std::span<const float> radiance, Recording& recording);

}  // namespace voxilux
