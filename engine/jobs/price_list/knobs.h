#pragma once

// Which settings the price list compares.

#include <optional>
#include <string>
#include <vector>

#include "plan/render_plan.h"

namespace voxilux {

// One way to render a scene, whatever the samples.
struct Way {
    RenderSettings settings;
    PlanRequest request;
    std::optional<Traversal> traversal;  // when it needs a world of its own

    bool operator==(const Way& other) const {
        return settings == other.settings && traversal == other.traversal &&
               request.wants_error == other.request.wants_error;
    }
};

// A value of a knob: `way` is an index into KnobDesign::ways.
struct KnobSetting {
    std::string name;
    std::size_t way = 0;
};

// Something that is approximated, and the settings to compare, the default among them.
struct Knob {
    std::string name;
    std::string label;
    std::string axis;  // what is changed
    std::string why;   // what is approximated, a sentence
    std::vector<KnobSetting> settings;
};

// What the issue of accuracy would name, and where there is nothing to choose.
struct FixedChoice {
    std::string name;
    std::string value;
    std::string why;
};

// Way 0 is the scene as it is planned. The knob `samples` has no settings: the price list takes every number
// of samples that it measures of way 0.
struct KnobDesign {
    std::vector<Way> ways;
    std::vector<Knob> knobs;
    std::vector<FixedChoice> fixed;
};

// "gather", "scatter" or "classic".
[[nodiscard]] std::string photon_method(const PhotonSettings& photons);

// The knobs of what the plan uses, one changed at a time. `base` is what the plan was made of, with the
// radius of photons that its pilot found.
[[nodiscard]] KnobDesign design_knobs(const RenderPlan& plan, const Way& base);

}  // namespace voxilux
