#include "compare/compare.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "base/error.h"
#include "base/file.h"
#include "estimators/flip.h"
#include "estimators/metrics.h"
#include "formats/image_file.h"
#include "parse_box.h"

namespace voxilux {
namespace {

using Json = nlohmann::ordered_json;

struct Comparison {
    Image ref, test;
    Metrics metrics;
    std::optional<FlipResult> flip;
    std::optional<double> flip_mean;
};

Selection selection_of(const CompareOptions& options, const std::optional<Image>& mask) {
    Selection selection{.mask = mask ? &*mask : nullptr};
    if (options.box.empty()) return selection;
    VX_ASSERT_EQ(options.box.size(), 4u);
    selection.box = PixelBox{options.box[0], options.box[1], options.box[2], options.box[3]};
    return selection;
}

Comparison compare(const CompareOptions& options) {
    Comparison result{.ref = read_image(options.ref), .test = read_image(options.test)};
    std::optional<Image> mask;
    if (!options.mask.empty()) mask = read_image(options.mask);
    const std::vector<std::size_t> pixels =
        selected_pixels(result.ref.width, result.ref.height, selection_of(options, mask));
    result.metrics = measure_difference(result.ref, result.test, pixels);
    result.flip = flip(result.ref, result.test);
    if (result.flip) result.flip_mean = mean_flip(*result.flip, pixels);
    return result;
}

// The contract has exactly these keys; a number that is not finite prints as null.
Json json_of(const Comparison& c) {
    const Metrics& m = c.metrics;
    const auto or_null = [](const std::optional<double>& value) {
        return value ? Json(*value) : Json(nullptr);
    };
    return {{"rmse", m.rmse},
            {"mae", m.mae},
            {"relmse", m.relmse},
            {"smape", m.smape},
            {"flip", or_null(c.flip_mean)},
            {"psnr", or_null(m.psnr)},
            {"mean_ref", m.mean_ref},
            {"mean_test", m.mean_test},
            {"max_abs", m.max_abs}};
}

void print_facts(const Comparison& c) {
    const Metrics& m = c.metrics;
    fmt::print("rmse {:.6g}\nmae {:.6g}\nrelmse {:.6g}\n", m.rmse, m.mae, m.relmse);
    fmt::print("relmse without the worst 0.1% of pixels {:.6g}\nsmape {:.6g}\n", m.trimmed_relmse, m.smape);
    if (c.flip_mean && c.flip->exposures > 0) {
        fmt::print("flip {:.6g} (HDR, {} exposures)\n", *c.flip_mean, c.flip->exposures);
    } else if (c.flip_mean) {
        fmt::print("flip {:.6g} (LDR)\n", *c.flip_mean);
    } else {
        fmt::print("flip cannot be computed: a value is not finite, or the reference is black\n");
    }
    fmt::print("psnr {}\n", m.psnr ? fmt::format("{:.6g} dB (peak {})", *m.psnr, kPsnrPeak) : "infinite");
    fmt::print("mean_ref {:.6g} {:.6g} {:.6g}\n", m.mean_ref[0], m.mean_ref[1], m.mean_ref[2]);
    fmt::print("mean_test {:.6g} {:.6g} {:.6g}\n", m.mean_test[0], m.mean_test[1], m.mean_test[2]);
    fmt::print("max_abs {:.6g}\npixels {}\n", m.max_abs, m.pixels);
}

void print_json(const Comparison& comparison, const std::string& target) {
    const std::string text = json_of(comparison).dump(1) + "\n";
    if (target == "-") {
        fmt::print("{}", text);
    } else {
        write_file_atomically(target, std::as_bytes(std::span(text)));
    }
}

// R G B: |test - reference|; flip.Y: the FLIP map. A PNG shows the FLIP map alone, or R G B where there is
// none.
void write_difference(const Comparison& c, const std::filesystem::path& path) {
    const auto ref = *colour_planes(c.ref);
    const auto test = *colour_planes(c.test);
    const std::array<std::string, 3> names = {"R", "G", "B"};
    Image image = make_image(c.ref.width, c.ref.height, names);
    const bool is_png = path.extension() == ".png";
    for (std::size_t channel = 0; channel < names.size(); ++channel) {
        std::vector<float>& plane = image.channels[names[channel]].pixels;
        for (std::size_t i = 0; i < plane.size(); ++i)
            plane[i] = is_png && c.flip ? c.flip->error[i] : std::abs(test[channel][i] - ref[channel][i]);
    }
    if (c.flip && !is_png) image.channels["flip.Y"].pixels = c.flip->error;
    write_image(path, image);
}

std::optional<double> metric_named(const Comparison& c, const std::string& name) {
    if (name == "rmse") return c.metrics.rmse;
    if (name == "relmse") return c.metrics.relmse;
    if (name == "mae") return c.metrics.mae;
    if (name == "abs") return c.metrics.max_abs;
    if (name == "flip") return c.flip_mean;
    throw Error(ExitCode::usage, fmt::format("no limit can be set on '{}'", name));
}

int check_limits(const Comparison& comparison, const std::map<std::string, double>& limits) {
    int code = static_cast<int>(ExitCode::done);
    for (const auto& [name, limit] : limits) {
        const std::optional<double> value = metric_named(comparison, name);
        if (value && *value <= limit) continue;  // written so that a NaN does not pass
        const std::string shown = value ? fmt::format("is {:.6g}, ", *value) : "cannot be computed, ";
        fmt::print(stderr, "{} {}over --max-{} {}\n", name, shown, name, limit);
        code = static_cast<int>(ExitCode::over_threshold);
    }
    return code;
}

double checked_limit(const std::string& key, double limit) {
    if (!(limit >= 0.0))
        throw CLI::ValidationError("--max-" + key, fmt::format("{} is not 0 or above", limit));
    return limit;
}

std::vector<int> checked_box(const std::string& text) {
    const auto box = parse_box(text);
    if (!box) throw CLI::ValidationError("--box", fmt::format("'{}' is not X0,Y0,X1,Y1 in pixels", text));
    return {box->begin(), box->end()};
}

}  // namespace

CLI::App* add_compare(CLI::App& app, CompareOptions& options) {
    CLI::App* command =
        app.add_subcommand("compare", "metrics between two images (EXR or PNG) in linear light");
    command->add_option("REF", options.ref, "reference image")->required()->type_name("");
    command->add_option("TEST", options.test, "image to judge")->required()->type_name("");
    command->add_option("--json", options.json, "write the metrics as JSON; - is standard output")
        ->type_name("FILE");
    command
        ->add_option("--mask", options.mask,
                     "image of the same size; pixels that are black in it are left out")
        ->type_name("FILE");
    command
        ->add_option_function<std::string>(
            "--box", [&options](const std::string& text) { options.box = checked_box(text); },
            "compare columns X0 to X1-1 and rows Y0 to Y1-1 only")
        ->type_name("X0,Y0,X1,Y1");
    command->add_option("--diff", options.diff, "write a picture of the difference, .exr or .png")
        ->type_name("FILE");
    for (const char* name : {"rmse", "relmse", "flip", "mae", "abs"}) {
        const std::string key = name;
        command
            ->add_option_function<double>(
                "--max-" + key,
                [&options, key](double limit) { options.max[key] = checked_limit(key, limit); },
                "exit with code 5 when " + (key == "abs" ? "the largest difference" : key) + " is over this")
            ->type_name("E");
    }
    return command;
}

int run_compare(const CompareOptions& options) {
    const Comparison comparison = compare(options);
    if (options.json != "-") print_facts(comparison);
    if (!options.json.empty()) print_json(comparison, options.json);
    if (comparison.metrics.non_finite > 0) {
        fmt::print(stderr, "{} of {} pixels hold a NaN or an infinity: no metric is defined\n",
                   comparison.metrics.non_finite, comparison.metrics.pixels);
    }
    if (!options.diff.empty()) write_difference(comparison, options.diff);
    return check_limits(comparison, options.max);
}

}  // namespace voxilux
