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

namespace voxilux {

// What a display can show of a film. `error` is the standard error of the luminance, as film_image() has it;
// `cells` are no film, but what the occlusion cells of the last sample hold: how many occlusion rays each.
enum class DisplayChannel : std::uint8_t { color, albedo, normal, position, depth, ao, sun, error, cells };
inline constexpr std::array<std::string_view, 9> kDisplayChannelNames{
    "color", "albedo", "normal", "position", "depth", "ao", "sun", "error", "cells"};

// What is shown beyond the divider; `map` is of numbers from 0 to 1, in place of the reference.
enum class DisplayComparison : std::uint8_t { none, reference, difference, map };

// How a film is shown.
struct DisplayLook {
    DisplayChannel channel = DisplayChannel::color;
    float exposure = 1.0f;  // factor of `color`
    ToneMap curve = ToneMap::filmic;
    glm::vec3 low{0.0f};   // values where false colours begin; of numbers the first component
    glm::vec3 high{1.0f};  // and where they end; of `error` and `cells` these are logarithms to base 10
    DisplayComparison comparison = DisplayComparison::none;  // with a reference, of `color`
    std::uint32_t divider = 0;                               // column from which on it is compared
    bool is_bgr = false;                                     // blue is the lowest byte of a code, not red

    bool operator==(const DisplayLook&) const = default;
};

// How many samples the rows of a film have.
struct SampleCounts {
    std::uint32_t samples = 0;     // of all rows
    std::uint32_t rows_ahead = 0;  // rows from the top that have one more
};

// An image on the device: [height][width] words of four 8-bit sRGB codes.
struct DisplayBuffer {
    std::string buffer;
    glm::ivec2 size{0};  // pixels
};

// Whether the film of a plan has the channel.
[[nodiscard]] bool has_channel(const RenderPlan& plan, DisplayChannel channel);

// The film as codes, for whoever presents it on the device; pixels with no sample are black. It is recorded
// where a display is asked for, and is no part of a frame. A comparison needs record_display_reference() in
// this recording or an earlier one.
DisplayBuffer record_display_resolve(const RenderPlan& plan, const SampleCounts& counts,
                                     const DisplayLook& look, Recording& recording);

// The occlusion cells as codes, black where a pixel has none. `sample` is the last one that the plan took,
// counted from 0 since its cells were emptied.
DisplayBuffer record_display_cells(const RenderPlan& plan, std::uint64_t sample, const DisplayLook& look,
                                   Recording& recording);

// Uploads the reference: [height][width][3] radiance of the size of the image, or three times the number of a
// map.
void record_display_reference(const RenderPlan& plan, std::span<const float> radiance, Recording& recording);

}  // namespace voxilux
