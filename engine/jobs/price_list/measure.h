#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "jobs/price_list/error_split.h"
#include "jobs/price_list/parameters.h"
#include "jobs/render_session.h"

namespace voxilux {

// One image to render.
struct MeasureJob {
    Configuration configuration;
    std::int64_t frame = 0;
    std::uint32_t seed = 0;
    std::uint32_t samples = 1;
    std::optional<double> time_limit_s;  // for this image
};

struct Measured {
    RenderOutcome outcome;
    double time_s = 0.0;  // device time of the samples
};

// Renders the image. The session must have the configuration's scene and structure. Throws Error(interrupted)
// when a signal ends it early: a partial image is no measurement.
[[nodiscard]] Measured measure_once(RenderSession& session, const MeasureJob& job);

// Runs `work`; false when it was interrupted.
[[nodiscard]] bool is_measured(const std::function<void()>& work);

// The settings of a run that the price list shows: those that its plan uses.
[[nodiscard]] nlohmann::ordered_json settings_json(const Configuration& configuration, const RenderPlan& plan,
                                                   std::uint32_t samples);

// One number of samples of a configuration, rendered several times with different random numbers.
struct Level {
    std::uint32_t samples = 0;
    std::vector<double> times_s;
    SplitError error;
    ErrorEstimate claimed;  // the first image's own estimate
    Image picture;          // the first one
};

// A configuration, its renderer, and its results.
struct MeasuredConfiguration {
    Configuration configuration;
    std::unique_ptr<RenderSession> own;  // where it needs a world of its own
    RenderSession* session = nullptr;
    RenderPlan plan;
    double load_s = 0.0;
    double per_sample_s = 0.0;
    std::string refusal;        // why it cannot run; else empty
    std::vector<Level> levels;  // by increasing number of samples
    std::optional<std::uint64_t>
        other_pixels;  // pixels that differ from configuration 0 with the same random numbers
};

// What all configurations share.
struct Workshop {
    Scene scene;
    RenderOptions options;
    std::int64_t frame = 0;
    std::uint32_t seed = 0;  // all runs derive their random numbers from it
    std::size_t repeats = 3;
    const Image* reference = nullptr;
    ReferenceNoise noise;
    std::function<void(double share, std::uint32_t samples)> on_progress;  // of the stage
    std::function<double()> left_s;                                        // remaining time of the stage
};

// The configurations of a design, each rendered once to compile its shaders and once to time a sample.
// Configuration 0 and all that share its world use `session`. Other worlds are built while `may_load` accepts
// the time that the last one took.
[[nodiscard]] std::vector<MeasuredConfiguration> prepare_configurations(
    const Workshop& workshop, const ParameterDesign& design, RenderSession& session,
    const std::function<bool(double)>& may_load);

// How many samples each configuration takes.
struct SamplePlan {
    std::uint32_t top = 1;  // of most configurations; their images are compared at this count
    std::vector<std::vector<std::uint32_t>>
        of_configuration;  // increasing; empty for configurations that cannot run
    double cost_s = 0.0;   // expected time
};

// `asked` samples, halved until all configurations together take at most `budget_s`: a sixteenth, a quarter
// and all of them, and for configuration 0 every power of two. Configurations that are too slow for their
// share take fewer.
[[nodiscard]] SamplePlan plan_samples(const std::vector<MeasuredConfiguration>& configurations,
                                      std::uint32_t asked, std::size_t repeats, double budget_s);

// Measures the configurations in turns, few samples first, then doubles up to `asked` while Workshop::left_s
// allows, and configuration 0 alone once more. Returns the number of samples that most configurations have
// reached.
[[nodiscard]] std::uint32_t measure_levels(const Workshop& workshop, const SamplePlan& plan,
                                           std::uint32_t asked,
                                           std::vector<MeasuredConfiguration>& configurations);

}  // namespace voxilux
