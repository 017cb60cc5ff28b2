#include "jobs/price_list/parameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "scene/technique_choice.h"
#include "world/march_world.h"

namespace voxilux {
namespace {

// Adds configurations that differ from the first in one setting.
class Designer {
  public:
    explicit Designer(const Configuration& base) { design_.configurations.push_back(base); }

    void begin(Parameter parameter) { design_.parameters.push_back(std::move(parameter)); }

    // A configuration that exists already is reused.
    void add(const std::string& name, const std::function<void(Configuration&)>& change) {
        Configuration configuration = design_.configurations.front();
        change(configuration);
        const auto known = std::ranges::find(design_.configurations, configuration);
        const auto index = static_cast<std::size_t>(known - design_.configurations.begin());
        if (known == design_.configurations.end()) design_.configurations.push_back(configuration);
        std::vector<ParameterSetting>& settings = design_.parameters.back().settings;
        if (std::ranges::find(settings, index, &ParameterSetting::configuration) == settings.end())
            settings.push_back({name, index});
    }

    void fix(FixedChoice choice) { design_.fixed.push_back(std::move(choice)); }

    [[nodiscard]] const Configuration& base() const { return design_.configurations.front(); }

    // Parameters with only one setting are left out.
    [[nodiscard]] ParameterDesign result() {
        std::erase_if(design_.parameters, [](const Parameter& parameter) {
            return parameter.name != "samples" && parameter.settings.size() < 2;
        });
        return std::move(design_);
    }

  private:
    ParameterDesign design_;
};

void design_sequence(Designer& designer) {
    designer.begin({.name = "sequence",
                    .label = "sequence",
                    .axis = "sequence of sample points",
                    .why = "Points that are spread more evenly than random ones leave less noise."});
    designer.add("sobol",
                 [](Configuration& configuration) { configuration.settings.sequence = Sequence::sobol; });
    designer.add("halton",
                 [](Configuration& configuration) { configuration.settings.sequence = Sequence::halton; });
    designer.add("white",
                 [](Configuration& configuration) { configuration.settings.sequence = Sequence::white; });
}

void design_traversal(const RenderPlan& plan, Designer& designer) {
    designer.begin({.name = "traversal",
                    .label = "traversal",
                    .axis = "structure that rays march through",
                    .why = "All structures find the same cells, so that only time and memory differ."});
    for (std::size_t i = 0; i < kTraversalCount; ++i) {
        const auto traversal = static_cast<Traversal>(i);
        designer.add(std::string(name_of(traversal)), [&](Configuration& configuration) {
            if (traversal != plan.world.traversal) configuration.traversal = traversal;
        });
    }
}

void design_occlusion(const RenderPlan& plan, Designer& designer) {
    const AoMethod planned = plan.ao.method;
    designer.begin({.name = "ao",
                    .label = "occlusion",
                    .axis = "technique for occlusion",
                    .why =
                        "Each pixel traces its own occlusion rays, or pixels share samples in cells of the "
                        "surface: less noise, more blur."});
    const auto method = [&](AoMethod wanted) {
        return [planned, wanted](Configuration& configuration) {
            if (planned != wanted) configuration.settings.ao.method = wanted;
        };
    };
    designer.add("brute", method(AoMethod::brute));
    designer.add("hash", method(AoMethod::hash));

    designer.begin({.name = "ao_cell",
                    .label = "occlusion cells",
                    .axis = "width of a shared cell, pixels",
                    .why = "Wider cells share more samples and blur more."});
    const float usual = designer.base().settings.ao.cell_px;
    for (const float factor : {0.25f, 0.5f, 1.0f, 2.0f, 4.0f}) {
        designer.add(fmt::format("{:g} px", factor * usual), [&](Configuration& configuration) {
            method(AoMethod::hash)(configuration);
            configuration.settings.ao.cell_px = factor * usual;
        });
    }

    designer.begin({.name = "ao_rays",
                    .label = "occlusion rays",
                    .axis = "occlusion rays per sample",
                    .why = "The visible fraction of the sky is a mean over this many rays."});
    const std::uint32_t rays = designer.base().settings.ao_rays;
    for (const std::uint32_t factor : {1u, 2u, 4u, 8u})
        designer.add(fmt::format("{}", factor * rays),
                     [&](Configuration& configuration) { configuration.settings.ao_rays = factor * rays; });
}

// Cost and gain of paths against the techniques that replace them.
void design_indirect(const RenderPlan& plan, Designer& designer) {
    designer.begin(
        {.name = "indirect",
         .label = "indirect light",
         .axis = "what finds light between surfaces",
         .why = "Paths find it without bias. Occlusion approximates only that of the sky, and without "
                "either surfaces receive direct light only, from sun, sky and emitters."});
    designer.add("paths", [](Configuration&) {});
    const auto leave_out = [](Configuration& configuration) {
        choose_technique("indirect", "none", configuration.settings);
    };
    if (plan.has(Effect::sky)) designer.add("ao", leave_out);
    designer.add("off", [&](Configuration& configuration) {
        leave_out(configuration);
        configuration.request.effects.switches[Effect::ao] = Switch::off;
    });
}

// What stands in for rough metal and glass is that of a plan whose caustics are not left to paths.
void design_rough(Designer& designer) {
    designer.begin({.name = "rough",
                    .label = "rough metal and glass",
                    .axis = "how rough surfaces scatter",
                    .why =
                        "Microfacets, or in their place a mix of a mirror and a diffuse surface, and clear "
                        "glass, whose caustics are found by photons."});
    designer.add("microfacets", [](Configuration&) {});
    designer.add("stand-in", [](Configuration& configuration) {
        choose_technique("caustics", "photons", configuration.settings);
    });
}

void set_photon_method(const std::string& method, PhotonSettings& photons) {
    photons.classic = method == "classic";
    photons.scatter = method == "scatter";
}

void design_photon_numbers(const RenderPlan& plan, Designer& designer) {
    designer.begin({.name = "photons",
                    .label = "photons",
                    .axis = "photons per iteration",
                    .why = "More photons in each iteration leave less noise for the same radius."});
    const double count = plan.photons.count();
    for (const double factor : {0.25, 0.5, 1.0, 2.0, 4.0}) {
        const double wanted =
            std::clamp(std::round(factor * count), 1.0, static_cast<double>(PhotonSettings::kMaxCount));
        const auto photons = static_cast<std::uint32_t>(wanted);
        designer.add(fmt::format("{}", photons), [&](Configuration& configuration) {
            if (photons != plan.photons.count()) configuration.settings.photons.count = photons;
        });
    }
    designer.begin({.name = "radius",
                    .label = "photon radius",
                    .axis = "radius of the first iteration, voxels",
                    .why = "Light is averaged over a kernel: a wide one blurs, a narrow one is noisy."});
    const double radius = plan.photons.radius;
    for (const double factor : {0.25, 0.5, 1.0, 2.0, 4.0}) {
        designer.add(fmt::format("{:.3g}", factor * radius), [&](Configuration& configuration) {
            configuration.settings.photons.radius = factor * radius;
        });
    }
    designer.begin(
        {.name = "alpha",
         .label = "photon alpha",
         .axis = "exponent with which the radius shrinks",
         .why = "The smaller alpha, the faster kernels shrink: less blur in the end, more noise."});
    const double alpha = designer.base().settings.photons.alpha;
    for (const double value : {0.5, alpha, 0.8, 1.0})
        designer.add(fmt::format("{:.3g}", value),
                     [&](Configuration& configuration) { configuration.settings.photons.alpha = value; });
}

void design_photon_methods(Designer& designer) {
    designer.begin({.name = "gather",
                    .label = "photon search",
                    .axis = "gathering, splatting or per-pixel radii",
                    .why = "Points gather photons, or photons are splatted to points, with equal results; "
                           "classic gives each pixel a radius of its own."});
    const std::string planned = photon_method(designer.base().settings.photons);
    for (const char* method : {"gather", "scatter", "classic"}) {
        designer.add(method, [&](Configuration& configuration) {
            if (method != planned) set_photon_method(method, configuration.settings.photons);
        });
    }
    designer.begin({.name = "paths",
                    .label = "photon paths",
                    .axis = "what ends a path",
                    .why = "Roulette ends paths without bias; a depth that is too small loses light."});
    const auto cut = [](std::uint32_t depth) {
        return [depth](Configuration& configuration) {
            configuration.settings.photons.roulette = false;
            configuration.settings.photons.depth = depth;
        };
    };
    designer.add("roulette",
                 [](Configuration& configuration) { configuration.settings.photons.roulette = true; });
    designer.add("depth 2", cut(2));
    designer.add("depth 8", cut(8));
}

void design_estimate(const RenderPlan& plan, Designer& designer) {
    if (!plan.has_independent_samples()) {
        designer.fix({"error estimate", "from two halves",
                      "squares of samples give an error only where samples are independent: white noise or "
                      "photons"});
        return;
    }
    designer.begin({.name = "estimate",
                    .label = "error estimate",
                    .axis = "what the render sums of its samples",
                    .why = "Sums of squares, and of the bias of photons, give a more exact error than two "
                           "halves; they change no pixel."});
    designer.add("halves", [](Configuration&) {});
    designer.add("squares", [](Configuration& configuration) { configuration.request.wants_error = true; });
}

void name_fixed(const RenderPlan& plan, Designer& designer) {
    designer.fix(
        {"film sums", "64-bit integers, 24 fraction bits",
         "exact whatever the order and the number of samples: there are no float or compensated sums to "
         "choose"});
    designer.fix({"pixel filter", "box of one pixel", "a sample counts only for the pixel that contains it"});
    if (!plan.has(Effect::voxels)) return;
    designer.fix({"beams", "on",
                  "rays of a tile share the way to the first voxel that any of them can hit; "
                  "their hits stay the same"});
}

}  // namespace

std::string photon_method(const PhotonSettings& photons) {
    if (photons.classic) return "classic";
    return photons.scatter ? "scatter" : "gather";
}

ParameterDesign design_parameters(const RenderPlan& plan, const Configuration& base) {
    Designer designer(base);
    designer.begin({.name = "samples",
                    .label = "samples",
                    .axis = plan.photons.runs() ? "iterations: samples per pixel" : "samples per pixel",
                    .why = "A pixel is a mean over this many samples; noise falls with the square root of "
                           "their number."});
    design_sequence(designer);
    if (plan.has(Effect::voxels)) design_traversal(plan, designer);
    if (plan.has(Effect::ao)) design_occlusion(plan, designer);
    if (plan.is_by_paths(Effect::indirect)) design_indirect(plan, designer);
    if (plan.shows_rough) design_rough(designer);
    if (plan.photons.runs()) {
        design_photon_numbers(plan, designer);
        design_photon_methods(designer);
    }
    design_estimate(plan, designer);
    name_fixed(plan, designer);
    return designer.result();
}

}  // namespace voxilux
