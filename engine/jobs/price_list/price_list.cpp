#include "jobs/price_list/price_list.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "base/median.h"
#include "frame/footprint.h"

namespace voxilux {
namespace {

std::string id_of(const std::string& parameter, std::string setting) {
    std::ranges::replace_if(
        setting, [](char c) { return c == ' ' || c == '/'; }, '_');
    return parameter + "-" + setting;
}

std::size_t level_at(const MeasuredConfiguration& configuration, std::uint32_t samples) {
    const auto found = std::ranges::find(configuration.levels, samples, &Level::samples);
    const auto end = found == configuration.levels.end() ? found - 1 : found;
    return static_cast<std::size_t>(end - configuration.levels.begin());
}

std::vector<PricePoint> points_of(const MeasuredConfiguration& configuration, bool by_samples) {
    std::vector<PricePoint> points;
    for (const Level& level : configuration.levels) {
        if (level.error.is_limited) continue;
        const double x = by_samples ? level.samples : median(level.times_s);
        for (const double square : level.error.squares)
            points.push_back({x, std::sqrt(std::max(square, 0.0))});
    }
    return points;
}

// The first run of each image: the default settings of all parameters are the same configuration 0.
std::vector<PricedRun> distinct(const PriceList& list, const std::vector<PricedRun>& runs) {
    std::vector<PricedRun> result;
    for (const PricedRun& run : runs) {
        const auto is_same = [&](const PricedRun& other) {
            return other.configuration == run.configuration && other.level == run.level;
        };
        if (run.configuration == 0 && list.design.parameters[run.parameter].name != "samples") continue;
        if (std::ranges::find_if(result, is_same) == result.end()) result.push_back(run);
    }
    return result;
}

}  // namespace

const Level& level_of(const PriceList& list, const PricedRun& run) {
    return list.configurations[run.configuration].levels[run.level];
}

std::vector<PricedRun> front_of(const PriceList& list, const std::vector<PricedRun>& runs) {
    const std::vector<PricedRun> marks = distinct(list, runs);
    std::vector<PricePoint> points;
    for (const PricedRun& run : marks)
        points.push_back({median(level_of(list, run).times_s), level_of(list, run).error.total});
    std::vector<PricedRun> front;
    for (const std::size_t i : pareto_front(points))
        front.push_back(marks[i]);
    return front;
}

std::string picture_of_run(const PricedRun& run) {
    return fmt::format("pictures/{}.png", run.id);
}

std::string difference_of(std::string picture) {
    picture.insert(picture.rfind('.'), "-difference");
    return picture;
}

std::string file_of_row(const char* row, const std::string& id) {
    return fmt::format("pictures/{}-{}.png", row, id);
}

const PricedRun& run_of(const PriceList& list, const std::vector<PricedRun>& runs,
                        const EqualPicture& picture, bool is_first) {
    if (is_first) return *std::ranges::find_if(runs, [](const PricedRun& run) { return run.is_default; });
    const std::size_t configuration =
        list.design.parameters[picture.parameter].settings[picture.setting].configuration;
    return *std::ranges::find_if(runs, [&](const PricedRun& run) {
        return run.parameter == picture.parameter && run.configuration == configuration;
    });
}

std::vector<PricedRun> list_runs(const PriceList& list) {
    std::vector<PricedRun> runs;
    for (std::size_t parameter = 0; parameter < list.design.parameters.size(); ++parameter) {
        const std::string& name = list.design.parameters[parameter].name;
        const auto first = static_cast<std::ptrdiff_t>(runs.size());
        const std::vector<Level>& levels = list.configurations.front().levels;
        for (std::size_t level = 0; name == "samples" && level < levels.size(); ++level) {
            const std::string setting = fmt::format("{}", levels[level].samples);
            runs.push_back({.id = id_of(name, setting),
                            .parameter = parameter,
                            .setting = setting,
                            .level = level,
                            .is_default = levels[level].samples == list.top});
        }
        for (const ParameterSetting& setting : list.design.parameters[parameter].settings) {
            const MeasuredConfiguration& configuration = list.configurations[setting.configuration];
            if (configuration.levels.empty()) continue;
            runs.push_back({.id = id_of(name, setting.name),
                            .parameter = parameter,
                            .setting = setting.name,
                            .configuration = setting.configuration,
                            .level = level_at(configuration, list.top),
                            .is_default = setting.configuration == 0});
        }
        std::stable_sort(runs.begin() + first, runs.end(), [&](const PricedRun& a, const PricedRun& b) {
            return median(level_of(list, a).times_s) < median(level_of(list, b).times_s);
        });
    }
    return runs;
}

std::optional<Slope> slope_of(const MeasuredConfiguration& configuration) {
    return fit_slope(points_of(configuration, false));
}

std::optional<Slope> slope_of_samples(const MeasuredConfiguration& configuration) {
    return fit_slope(points_of(configuration, true));
}

std::string to_csv(const PriceList& list) {
    std::string text =
        "knob,setting,is_default,samples,time_s,time_low_s,time_high_s,error,noise,bias,bias_low,bias_high,"
        "is_limited,memory_bytes,load_s\n";
    const auto add = [&](const std::string& parameter, const std::string& setting,
                         const MeasuredConfiguration& configuration) {
        for (const Level& level : configuration.levels) {
            const SplitError& error = level.error;
            text += fmt::format(
                "{},{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{},{},{:.4g}\n",
                parameter, setting, &configuration == &list.configurations.front() ? 1 : 0, level.samples,
                median(level.times_s), std::ranges::min(level.times_s), std::ranges::max(level.times_s),
                error.total, error.noise, error.bias, error.bias_low, error.bias_high,
                error.is_limited ? 1 : 0, footprint(configuration.plan).total_bytes(), configuration.load_s);
        }
    };
    for (const Parameter& parameter : list.design.parameters) {
        if (parameter.name == "samples") add(parameter.name, "default", list.configurations.front());
        for (const ParameterSetting& setting : parameter.settings)
            add(parameter.name, setting.name, list.configurations[setting.configuration]);
    }
    return text;
}

std::string describe(const PriceList& list) {
    const std::vector<PricedRun> runs = list_runs(list);
    const Reference& reference = list.reference;
    std::string text =
        fmt::format("reference {} samples, {:.1f} s{}, noise {:.2g} %\n", reference.samples, reference.time_s,
                    reference.is_cached ? " (cached)" : "", 100.0 * std::sqrt(reference.noise().square));
    text += fmt::format("compared  at {} samples per pixel{}\n", list.top,
                        list.top < list.asked ? fmt::format(", for lack of time for {}", list.asked) : "");
    for (const PricedRun& run : runs) {
        const Level& level = level_of(list, run);
        const std::string bias = level.error.bias_low > 0.0
                                     ? fmt::format("bias {:.3g} %", 100.0 * level.error.bias)
                                     : fmt::format("no bias over {:.3g} %", 100.0 * level.error.bias_high);
        text += fmt::format("run       {:<22} {:>9.4f} s   error {:>7.3f} %, noise {:>7.3f} %, {}{}\n",
                            run.id, median(level.times_s), 100.0 * level.error.total,
                            100.0 * level.error.noise, bias, run.is_default ? "  (default)" : "");
    }
    if (const std::optional<Slope> slope = slope_of(list.configurations.front()))
        text += fmt::format("slope     {:.3f} ({:.3f} to {:.3f}) of error against time, by samples\n",
                            slope->value, slope->low, slope->high);
    for (const EffectPrice& price : list.effects)
        text += fmt::format("effect    {:<10} {:<10} {:>8.2f} ms a sample, error {:>6.2f} % without it{}\n",
                            name_of(price.effect), price.on ? "on" : "forced on", price.ms_per_sample,
                            100.0 * price.error, price.is_beyond_noise ? "" : " (within noise)");
    for (const PricedRun& run : front_of(list, runs))
        text += fmt::format("front     {}\n", run.id);
    return text;
}

}  // namespace voxilux
