#pragma once

// Which settings the price list compares.

#include <optional>
#include <string>
#include <vector>

#include "plan/render_plan.h"

namespace voxilux {

// One configuration to render a scene, with any number of samples.
struct Configuration {
    RenderSettings settings;
    PlanRequest request;
    std::optional<Traversal> traversal;  // set when it needs a world of its own

    bool operator==(const Configuration& other) const {
        return settings == other.settings && traversal == other.traversal &&
               request.wants_error == other.request.wants_error &&
               request.effects.switches == other.request.effects.switches;
    }
};

// A value of a parameter: `configuration` is an index into ParameterDesign::configurations.
struct ParameterSetting {
    std::string name;
    std::size_t configuration = 0;
};

// Something that is approximated, and the settings to compare, including the default.
struct Parameter {
    std::string name;
    std::string label;
    std::string axis;  // what is changed
    std::string why;   // what is approximated, a sentence
    std::vector<ParameterSetting> settings;
};

// A choice that affects accuracy but has only one setting here.
struct FixedChoice {
    std::string name;
    std::string value;
    std::string why;
};

// Configuration 0 is the scene as planned. The parameter `samples` has no settings: the price list uses every
// number of samples measured of configuration 0.
struct ParameterDesign {
    std::vector<Configuration> configurations;
    std::vector<Parameter> parameters;
    std::vector<FixedChoice> fixed;
};

// "gather", "scatter" or "classic".
[[nodiscard]] std::string photon_method(const PhotonSettings& photons);

// The parameters of what the plan uses, one changed at a time. `base` is what the plan was made from, with
// the radius of photons that its pilot found.
[[nodiscard]] ParameterDesign design_parameters(const RenderPlan& plan, const Configuration& base);

}  // namespace voxilux
