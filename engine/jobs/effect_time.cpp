#include "jobs/effect_time.h"

#include <string>

namespace voxilux {
namespace {

// Passes that every image needs: no effect is charged for them.
bool is_of_frame(const std::string& stem) {
    return stem == "shade" || stem == "film" || stem == "world";
}

// The effect that a pass is charged to. Indirect light and caustics share their photons.
Effect payer_of(const RenderPlan& plan, const std::string& stem) {
    if (stem == "primary") return Effect::voxels;
    if (stem == "sphere") return Effect::spheres;
    if (stem == "photon") return plan.is_by_photons(Effect::indirect) ? Effect::indirect : Effect::caustics;
    if (stem == "path") return Effect::indirect;
    for (const EffectState& state : plan.effects) {
        if (name_of(state.effect) == stem) return state.effect;
    }
    return Effect::aov;
}

}  // namespace

double effect_ms(const RenderPlan& plan, std::span<const PassTime> passes, Effect effect) {
    double ms = 0.0;
    for (const PassTime& pass : passes) {
        const std::string stem = pass.label.substr(0, pass.label.find('.'));
        if (!is_of_frame(stem) && payer_of(plan, stem) == effect) ms += pass.ms;
    }
    return ms;
}

}  // namespace voxilux
