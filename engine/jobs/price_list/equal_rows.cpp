#include "jobs/price_list/equal_rows.h"

#include <algorithm>
#include <cmath>

#include "base/median.h"

namespace voxilux {
namespace {

// A target counts as reached within this factor: times of single images vary, and samples are integers.
constexpr double kNear = 1.25;
// Limits of the exponent of error against samples when it is extrapolated: bias makes it flat.
constexpr double kFlattest = -0.15;
constexpr double kSteepest = -1.0;

struct Choice {
    std::size_t parameter = 0;
    std::size_t setting = 0;
};

// The chosen configurations, each once.
std::vector<Choice> chosen(const ParameterDesign& design,
                           const std::vector<MeasuredConfiguration>& configurations) {
    std::vector<Choice> choices;
    std::vector<std::size_t> taken;
    const auto take = [&](std::size_t parameter, std::size_t setting) {
        const std::size_t configuration = design.parameters[parameter].settings[setting].configuration;
        if (configuration == 0 || configurations[configuration].levels.empty() ||
            std::ranges::find(taken, configuration) != taken.end())
            return;
        taken.push_back(configuration);
        choices.push_back({parameter, setting});
    };
    for (std::size_t parameter = 0; parameter < design.parameters.size(); ++parameter) {
        const std::size_t count = design.parameters[parameter].settings.size();
        if (count == 0 || design.parameters[parameter].name == "estimate") continue;
        take(parameter, 0);
        take(parameter, count - 1);
    }
    return choices;
}

const Level& level_of(const MeasuredConfiguration& configuration, std::uint32_t samples) {
    const auto found = std::ranges::find(configuration.levels, samples, &Level::samples);
    return found == configuration.levels.end() ? configuration.levels.back() : *found;
}

double seconds_per_sample(const MeasuredConfiguration& configuration) {
    return median(configuration.levels.back().times_s) / configuration.levels.back().samples;
}

EqualPicture of_level(const Level& level) {
    return {.samples = level.samples,
            .time_s = median(level.times_s),
            .error = level.error.total,
            .picture = level.picture};
}

EqualPicture render(const Workshop& workshop, const MeasuredConfiguration& configuration, double samples) {
    const double most = 1u << 20;
    const auto whole = static_cast<std::uint32_t>(std::lround(std::clamp(samples, 1.0, most)));
    Measured measured = measure_once(*configuration.session, {.configuration = configuration.configuration,
                                                              .frame = workshop.frame,
                                                              .seed = workshop.seed + 1,
                                                              .samples = whole});
    EqualPicture result{.samples = whole, .time_s = measured.time_s};
    result.picture = colours_alone(std::move(measured.outcome.image));
    const double square = relative_square(result.picture, *workshop.reference) - workshop.noise.square;
    result.error = std::sqrt(std::max(square, 0.0));
    return result;
}

// The level `base` of configuration 0, and an image of every chosen configuration with the number of samples
// that `samples_of` gives. An image reaches the target when its `member` is near it or below.
template <class SamplesOf>
EqualRow make_row(const Workshop& workshop, const ParameterDesign& design,
                  const std::vector<MeasuredConfiguration>& configurations, const Level& base, double target,
                  const SamplesOf& samples_of, double EqualPicture::*member) {
    EqualRow row{.target = target};
    row.pictures.push_back(of_level(base));
    for (const auto& [parameter, setting] : chosen(design, configurations)) {
        if (workshop.left_s() <= 0.0) break;
        const MeasuredConfiguration& configuration =
            configurations[design.parameters[parameter].settings[setting].configuration];
        EqualPicture picture;
        if (!is_measured([&] { picture = render(workshop, configuration, samples_of(configuration)); }))
            break;
        picture.parameter = parameter;
        picture.setting = setting;
        picture.is_reached = picture.*member <= kNear * target;
        row.pictures.push_back(std::move(picture));
    }
    return row;
}

}  // namespace

double samples_for_error(const std::vector<Level>& levels, double error) {
    const Level& last = levels.back();
    if (!(error > 0.0) || !(last.error.total > 0.0)) return last.samples;
    double exponent = -0.5;
    if (levels.size() > 1) {
        const Level& before = levels[levels.size() - 2];
        const double ratio = last.error.total / before.error.total;
        exponent = std::log(ratio) / std::log(static_cast<double>(last.samples) / before.samples);
    }
    if (std::isnan(exponent)) exponent = -0.5;
    exponent = std::clamp(exponent, kSteepest, kFlattest);
    return last.samples * std::pow(error / last.error.total, 1.0 / exponent);
}

EqualRow equal_time_row(const Workshop& workshop, const ParameterDesign& design,
                        const std::vector<MeasuredConfiguration>& configurations, std::uint32_t samples) {
    const Level& base = level_of(configurations.front(), samples);
    const double target = median(base.times_s);
    return make_row(
        workshop, design, configurations, base, target,
        [&](const MeasuredConfiguration& configuration) {
            return target / seconds_per_sample(configuration);
        },
        &EqualPicture::time_s);
}

EqualRow equal_error_row(const Workshop& workshop, const ParameterDesign& design,
                         const std::vector<MeasuredConfiguration>& configurations, std::uint32_t samples,
                         double max_s) {
    const Level& base = level_of(configurations.front(), samples);
    const double target = base.error.total;
    return make_row(
        workshop, design, configurations, base, target,
        [&](const MeasuredConfiguration& configuration) {
            return std::min(samples_for_error(configuration.levels, target),
                            max_s / seconds_per_sample(configuration));
        },
        &EqualPicture::error);
}

}  // namespace voxilux
