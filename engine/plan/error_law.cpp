#include "plan/error_law.h"

namespace voxilux {

ErrorLaw error_law(const RenderPlan& plan) {
    for (const ChosenTechnique& chosen : plan.techniques) {
        if (const auto noise = chosen.technique->noise)
            return {.noise = *noise, .alpha = plan.settings.photons.alpha, .has_bias = plan.sums_bias};
    }
    return {.noise = plan.has_independent_samples() ? NoiseLaw::independent : NoiseLaw::sequence};
}

}  // namespace voxilux
