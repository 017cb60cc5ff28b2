#include "jobs/photon_report.h"

namespace voxilux {

nlohmann::ordered_json photons_json(const RenderPlan& plan) {
    if (!plan.photons.runs()) return nullptr;
    const PhotonSettings& settings = plan.settings.photons;
    nlohmann::ordered_json json = {{"per_iteration", plan.photons.count()},
                                   {"of_lamps", plan.photons.emitter_photons},
                                   {"of_sun", plan.photons.sun_photons},
                                   {"power", plan.photons.power},
                                   {"power_left_out", plan.photons.power_left_out},
                                   {"runs", plan.photons.run_count()},
                                   {"capacity", plan.photons.capacity}};
    const bool is_known = plan.photons.radius > 0.0;
    json["first_radius"] = is_known ? nlohmann::ordered_json(plan.photons.radius) : nullptr;
    json["alpha"] = settings.alpha;
    json["method"] = settings.scatter ? "scatter" : settings.classic ? "classic" : "gather";
    return json;
}

}  // namespace voxilux
