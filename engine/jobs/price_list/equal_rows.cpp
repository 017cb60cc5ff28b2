#include "jobs/price_list/equal_rows.h"

#include <algorithm>
#include <cmath>

#include "base/median.h"

namespace voxilux {
namespace {

// A row is reached within this factor: times of single pictures scatter, and samples are whole numbers.
constexpr double kNear = 1.25;
// The most and the least that an error may fall with samples when it is extended: bias makes it flat.
constexpr double kFlattest = -0.15;
constexpr double kSteepest = -1.0;

struct Choice {
    std::size_t knob = 0;
    std::size_t setting = 0;
};

// Each way once.
std::vector<Choice> chosen(const KnobDesign& design, const std::vector<MeasuredWay>& ways) {
    std::vector<Choice> choices;
    std::vector<std::size_t> taken;
    const auto take = [&](std::size_t knob, std::size_t setting) {
        const std::size_t way = design.knobs[knob].settings[setting].way;
        if (way == 0 || ways[way].levels.empty() || std::ranges::find(taken, way) != taken.end()) return;
        taken.push_back(way);
        choices.push_back({knob, setting});
    };
    for (std::size_t knob = 0; knob < design.knobs.size(); ++knob) {
        const std::size_t count = design.knobs[knob].settings.size();
        if (count == 0 || design.knobs[knob].name == "estimate") continue;
        take(knob, 0);
        take(knob, count - 1);
    }
    return choices;
}

const Level& level_of(const MeasuredWay& way, std::uint32_t samples) {
    const auto found = std::ranges::find(way.levels, samples, &Level::samples);
    return found == way.levels.end() ? way.levels.back() : *found;
}

double seconds_per_sample(const MeasuredWay& way) {
    return median(way.levels.back().times_s) / way.levels.back().samples;
}

EqualPicture of_level(const Level& level) {
    return {.samples = level.samples,
            .time_s = median(level.times_s),
            .error = level.error.total,
            .picture = level.picture};
}

EqualPicture render(const Workshop& workshop, const MeasuredWay& way, double samples) {
    const double most = 1u << 20;
    const auto whole = static_cast<std::uint32_t>(std::lround(std::clamp(samples, 1.0, most)));
    Measured measured = measure_once(
        *way.session, {.way = way.way, .frame = workshop.frame, .seed = workshop.seed + 1, .samples = whole});
    EqualPicture result{.samples = whole, .time_s = measured.time_s};
    result.picture = colours_of(std::move(measured.outcome.image));
    const double square = relative_square(result.picture, *workshop.reference) - workshop.noise.square;
    result.error = std::sqrt(std::max(square, 0.0));
    return result;
}

// The level `base` of way 0, and a picture of every chosen way with so many samples as `samples_of` says. One
// is reached when its `member` is near the target or below.
template <class SamplesOf>
EqualRow make_row(const Workshop& workshop, const KnobDesign& design, const std::vector<MeasuredWay>& ways,
                  const Level& base, double target, const SamplesOf& samples_of,
                  double EqualPicture::*member) {
    EqualRow row{.target = target};
    row.pictures.push_back(of_level(base));
    for (const auto& [knob, setting] : chosen(design, ways)) {
        if (workshop.left_s() <= 0.0) break;
        const MeasuredWay& way = ways[design.knobs[knob].settings[setting].way];
        EqualPicture picture = render(workshop, way, samples_of(way));
        picture.knob = knob;
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

EqualRow equal_time_row(const Workshop& workshop, const KnobDesign& design,
                        const std::vector<MeasuredWay>& ways, std::uint32_t samples) {
    const Level& base = level_of(ways.front(), samples);
    const double target = median(base.times_s);
    return make_row(
        workshop, design, ways, base, target,
        [&](const MeasuredWay& way) { return target / seconds_per_sample(way); }, &EqualPicture::time_s);
}

EqualRow equal_error_row(const Workshop& workshop, const KnobDesign& design,
                         const std::vector<MeasuredWay>& ways, std::uint32_t samples, double most_s) {
    const Level& base = level_of(ways.front(), samples);
    const double target = base.error.total;
    return make_row(
        workshop, design, ways, base, target,
        [&](const MeasuredWay& way) {
            return std::min(samples_for_error(way.levels, target), most_s / seconds_per_sample(way));
        },
        &EqualPicture::error);
}

}  // namespace voxilux
