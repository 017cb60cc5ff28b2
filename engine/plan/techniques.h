#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "estimators/error_curve.h"
#include "plan/effects.h"
#include "plan/plan_ao.h"
#include "scene/scene.h"

namespace voxilux {

// A way to compute an effect. Callers ask for a property, not for a name.
struct Technique {
    Effect effect = Effect::voxels;
    std::string_view name;      // as in scene/technique_choice.h
    std::string_view sentence;  // for the user
    bool by_photons = false;
    bool by_paths = false;
    bool biased = false;               // more samples do not remove all of its error
    bool tells_bias = false;           // the film can sum by how much it is off
    bool independent_samples = false;  // of a pixel, whatever sequence the camera rays follow
    bool shares_samples = false;       // between pixels, so that halves of the film tell no error
    bool whole_frame = false;       // each pass covers the image before the next: one film and dispatch tile
    bool whole_tiles = false;       // a tile costs nearly as much as a film tile
    bool uneven_samples = false;    // the time of a sample depends on its number
    bool needs_pilot = false;       // to find parameters that the settings leave open
    std::optional<NoiseLaw> noise;  // where it determines that of the image
    std::string_view
        state;  // why samples depend on those before, and what to use instead; empty: they do not

    // Whether state on the device outlives a sample, and so a frame.
    [[nodiscard]] constexpr bool keeps_state() const { return !state.empty(); }
    // Whether samples may be taken anywhere and in any order, and their sums added up.
    [[nodiscard]] constexpr bool mergeable() const { return !keeps_state(); }
};

// All of them, those of an effect together.
[[nodiscard]] std::span<const Technique> all_techniques();

// Which technique computes an effect, and why.
struct ChosenTechnique {
    const Technique* technique = nullptr;  // of all_techniques()
    std::string reason;                    // one clause, shown to the user

    bool operator==(const ChosenTechnique&) const = default;
};

// Whether the plan leaves caustics of the sun to paths, whatever finds those of emitters. Faces of voxels
// send sunlight on in directions that paths know. Spheres spread it over all directions, where paths hardly
// ever find it.
[[nodiscard]] bool leaves_sun_to_paths(const EffectStates& effects, const RenderSettings& settings,
                                       bool has_specular_spheres);

// Whether rough metal and rough glass are shown as such, by paths that find all light; otherwise
// lobe_weights() says what stands in for them.
[[nodiscard]] bool shows_rough(const EffectStates& effects, const RenderSettings& settings, bool has_rough);

// The techniques of ao where it is on, and of caustics and indirect light, which is `none` where they are
// off.
[[nodiscard]] std::vector<ChosenTechnique> choose_techniques(const EffectStates& effects, const AoPlan& ao,
                                                             const RenderSettings& settings,
                                                             bool has_specular_spheres,
                                                             bool has_rough = false);

// That of the light of an atmosphere.
[[nodiscard]] ChosenTechnique choose_sky_technique(const RenderSettings& settings);

// The request with those effects off for which the settings choose `none`, unless the request switches them
// on.
[[nodiscard]] EffectRequest with_techniques(EffectRequest request, const RenderSettings& settings);

}  // namespace voxilux
