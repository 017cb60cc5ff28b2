#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "scene/facts.h"

namespace voxilux {

// What a user would name, in the order of the frame.
enum class Effect : std::uint8_t {
    lens,
    voxels,
    spheres,
    specular,
    ao,
    sun,
    sky,
    aerial,
    emission,
    direct,
    caustics,
    indirect,
    aov
};
inline constexpr std::size_t kEffectCount = static_cast<std::size_t>(Effect::aov) + 1;

// The user's choice for an effect; automatic leaves it to the scene.
enum class Switch : std::uint8_t { automatic, on, off };

struct EffectState {
    Effect effect = Effect::voxels;
    bool on = false;
    std::string reason;      // one clause, shown to the user
    bool by_choice = false;  // off, although the image would be different with it

    bool operator==(const EffectState&) const = default;
};

using EffectStates = std::array<EffectState, kEffectCount>;

[[nodiscard]] std::string_view name_of(Effect effect);

// The effect of that name; Error(usage) with the known names when there is none.
[[nodiscard]] Effect effect_named(std::string_view name);

// What the user asked for beyond the scene file.
struct EffectRequest {
    std::map<Effect, Switch> switches;
    bool wants_aov = false;      // an output can hold more than colour
    bool traces_paths = true;    // where indirect light is on, paths find it and the light of the sky
    bool traces_rough = true;    // rough metal and rough glass, which only paths that find all light can show
    bool is_perspective = true;  // the camera's projection
    bool wants_occlusion = false;  // a technique of ao is named, and none of indirect light
};

// Decides every effect. An effect runs when the scene calls for it: its need is met and something would
// change without it. `on` by the user overrides the second but never the first: voxels cannot be drawn where
// there are none.
[[nodiscard]] EffectStates decide_effects(const SceneFacts& facts, const EffectRequest& request);

}  // namespace voxilux
