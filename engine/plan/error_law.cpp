#include "plan/error_law.h"

namespace voxilux {

ErrorLaw error_law(const RenderPlan& plan) {
    if (plan.has_photons())
        return {.noise = NoiseLaw::photons, .alpha = plan.settings.photons.alpha, .has_bias = plan.sums_bias};
    return {.noise = plan.has_independent_samples() ? NoiseLaw::independent : NoiseLaw::sequence};
}

}  // namespace voxilux
