#pragma once

// Values of flags as people write them. Each throws Error(usage) that names the flag, the text and an
// example.

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "camera_choice.h"
#include "estimators/metrics.h"
#include "film/tonemap.h"
#include "jobs/frame_list.h"
#include "plan/effects.h"
#include "plan/render_plan.h"
#include "progress_line.h"
#include "scene/scene.h"
#include "scene/scene_camera.h"

namespace voxilux {

// Throws Error(usage).
[[noreturn]] void refuse(const std::string& complaint);

// "640x360": two whole numbers from 1 up. `flag` is for the message.
[[nodiscard]] glm::ivec2 parse_size(std::string_view flag, std::string_view text);

// "x0,y0,x1,y1": columns x0 to x1-1 and rows y0 to y1-1.
[[nodiscard]] PixelWindow parse_window(std::string_view flag, std::string_view text);

// The same, for image metrics.
[[nodiscard]] PixelBox parse_pixel_box(std::string_view flag, std::string_view text);

// "90s", "2m", "1h30m", "1.5h" or plain seconds, in seconds.
[[nodiscard]] double parse_duration(std::string_view text);

// "1-120", "1-120x5" (every fifth) or "7": whole numbers from 0 to kMaxFrame, the first not above the last.
[[nodiscard]] FrameList parse_frames(std::string_view text);

// "1%" or "0.01", as a share above 0.
[[nodiscard]] double parse_error_target(std::string_view text);

// "2/4": the second of four shards.
struct Shard {
    std::uint32_t index = 0;  // from 0
    std::uint32_t count = 1;
};
[[nodiscard]] Shard parse_shard(std::string_view text);

// "0-7,16-31x2": samples of a render.
[[nodiscard]] SampleSet parse_samples(std::string_view text);

// "2.5", a radius of photons in voxels; nothing for "auto".
[[nodiscard]] std::optional<double> parse_photon_radius(std::string_view text);

// A number from `low` to `high`.
[[nodiscard]] std::int64_t checked_range(std::string_view flag, std::int64_t value, std::int64_t low,
                                         std::int64_t high);

// Stops, or none for "auto".
[[nodiscard]] std::optional<float> parse_exposure(std::string_view text);

// on or off; filmic or plain; auto, never or json.
[[nodiscard]] bool parse_denoise(std::string_view choice);
[[nodiscard]] ToneMap parse_tone(std::string_view name);
[[nodiscard]] ProgressMode parse_progress(std::string_view name);

// sobol, halton or white.
[[nodiscard]] AoMethod parse_ao_method(std::string_view name);
[[nodiscard]] Sequence parse_sequence(std::string_view name);

// three-quarter, front, back, left, right, top, bottom or iso.
[[nodiscard]] View parse_view(std::string_view name);
// One of these, or else the name of a camera in the file.
[[nodiscard]] CameraChoice parse_camera(std::string_view name);

// "#rrggbb" or "sky".
[[nodiscard]] Background parse_background(std::string_view text);
[[nodiscard]] Projection parse_projection(std::string_view name);
[[nodiscard]] Turned parse_turned(std::string_view name);

// "x,y,z,yaw,pitch,fov": a place in scene space and degrees.
[[nodiscard]] Camera parse_viewpoint(std::string_view text);

// "NAME=on|off|auto".
struct EffectSwitch {
    Effect effect = Effect::voxels;
    Switch choice = Switch::automatic;
};
[[nodiscard]] EffectSwitch parse_effect_switch(std::string_view text);

}  // namespace voxilux
