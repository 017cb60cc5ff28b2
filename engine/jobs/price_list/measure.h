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

// One picture to render.
struct MeasureJob {
    Configuration configuration;
    std::int64_t frame = 0;
    std::uint32_t seed = 0;
    std::uint32_t samples = 1;
    std::optional<double> time_limit_s;  // of the picture
};

struct Measured {
    RenderOutcome outcome;
    double time_s = 0.0;  // of the samples, on the device
};

// Renders the picture. The session is one of the configuration's scene and structure. Throws
// Error(interrupted) when a signal ends it early: what it has then is no measurement.
[[nodiscard]] Measured measure_once(RenderSession& session, const MeasureJob& job);

// Whether `work` came to its end, and was not interrupted.
[[nodiscard]] bool is_measured(const std::function<void()>& work);

// The image without the channels that are no colour.
[[nodiscard]] Image colours_of(Image image);

// The settings of a run as the price list names them: those that its plan uses.
[[nodiscard]] nlohmann::ordered_json settings_json(const Configuration& configuration, const RenderPlan& plan,
                                                   std::uint32_t samples);

// One number of samples of a configuration, rendered as often as it was repeated, each time with other random
// numbers.
struct Level {
    std::uint32_t samples = 0;
    std::vector<double> times_s;
    SplitError error;
    ErrorEstimate claimed;  // by the first picture, of itself
    Image picture;          // the first
};

// A configuration, what renders it, and what it gave.
struct MeasuredConfiguration {
    Configuration configuration;
    std::unique_ptr<RenderSession> own;  // where it needs a world of its own
    RenderSession* session = nullptr;
    RenderPlan plan;
    double load_s = 0.0;
    double per_sample_s = 0.0;
    std::string refusal;        // why it cannot run; empty when it can
    std::vector<Level> levels;  // by rising samples
    std::optional<std::uint64_t>
        other_pixels;  // that differ from those of configuration 0 with the same random numbers
};

// What all configurations share.
struct Workshop {
    Scene scene;
    RenderOptions options;
    std::int64_t frame = 0;
    std::uint32_t seed = 0;  // the runs' random numbers follow from it
    std::size_t repeats = 3;
    const Image* reference = nullptr;
    ReferenceNoise noise;
    std::function<void(double share, std::uint32_t samples)> on_progress;  // of the stage
    std::function<double()> left_s;                                        // of the time for the stage
};

// The configurations of a design, each rendered once to compile its shaders and once to time a sample.
// Configuration 0 and all that share its world use `session`; worlds are built as long as `may_load(s)` of
// the last one's time says so.
[[nodiscard]] std::vector<MeasuredConfiguration> prepare_configurations(
    const Workshop& workshop, const ParameterDesign& design, RenderSession& session,
    const std::function<bool(double)>& may_load);

// How many samples to take of which configuration.
struct SamplePlan {
    std::uint32_t top = 1;  // of most configurations: what their pictures are compared at
    std::vector<std::vector<std::uint32_t>>
        of_configuration;  // rising; none of configurations that cannot run
    double cost_s = 0.0;   // expected
};

// `asked` samples, or so many halves of it that all configurations together take at most `budget_s`: a
// sixteenth, a quarter and all of them, and of configuration 0 every power of two. Configurations that are
// too slow for their share take fewer.
[[nodiscard]] SamplePlan plan_samples(const std::vector<MeasuredConfiguration>& configurations,
                                      std::uint32_t asked, std::size_t repeats, double budget_s);

// Measures the configurations in turns, few samples first, then twice as many again and again up to `asked`
// while Workshop::left_s allows, and configuration 0 alone once more. Returns the number of samples that most
// configurations have reached.
[[nodiscard]] std::uint32_t measure_levels(const Workshop& workshop, const SamplePlan& plan,
                                           std::uint32_t asked,
                                           std::vector<MeasuredConfiguration>& configurations);

}  // namespace voxilux
