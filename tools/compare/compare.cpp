#include "compare/compare.h"

#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "base/file.h"
#include "base/print.h"
#include "formats/image_file.h"
#include "jobs/or_null.h"
#include "parse_values.h"
#include "shared_flags.h"
#include "write_json.h"

namespace voxilux {
namespace {

ImageComparison compare(const CompareOptions& options) {
    std::optional<Image> mask;
    if (!options.mask.empty()) mask = read_image(options.mask);
    const Image reference = read_image(options.ref);  // read first: where both are broken, this one is named
    return compare_images(reference, read_image(options.test),
                          {.box = options.box, .mask = mask ? &*mask : nullptr});
}

void print_facts(const ImageComparison& c) {
    const Metrics& m = c.metrics;
    print_result("rmse {:.6g}\nmae {:.6g}\nrelmse {:.6g}\n", m.rmse, m.mae, m.relmse);
    print_result("relmse without the worst 0.1% of pixels {:.6g}\nsmape {:.6g}\n", m.trimmed_relmse, m.smape);
    if (c.flip_mean && c.flip->exposures > 0) {
        print_result("flip {:.6g} (HDR, {} exposures)\n", *c.flip_mean, c.flip->exposures);
    } else if (c.flip_mean) {
        print_result("flip {:.6g} (LDR)\n", *c.flip_mean);
    } else {
        print_result("flip cannot be computed: a value is not finite, or the reference is black\n");
    }
    print_result("psnr {}\n", m.psnr ? fmt::format("{:.6g} dB (peak {})", *m.psnr, kPsnrPeak) : "infinite");
    print_result("mean_ref {:.6g} {:.6g} {:.6g}\n", m.mean_ref[0], m.mean_ref[1], m.mean_ref[2]);
    print_result("mean_test {:.6g} {:.6g} {:.6g}\n", m.mean_test[0], m.mean_test[1], m.mean_test[2]);
    print_result("max_abs {:.6g}\npixels {}\n", m.max_abs, m.pixels);
}

std::optional<double> metric_named(const ImageComparison& c, const std::string& name) {
    if (name == "rmse") return c.metrics.rmse;
    if (name == "relmse") return c.metrics.relmse;
    if (name == "mae") return c.metrics.mae;
    if (name == "abs") return c.metrics.max_abs;
    if (name == "flip") return c.flip_mean;
    throw Error(ExitCode::usage, fmt::format("no limit can be set on '{}'", name));
}

int check_limits(const ImageComparison& comparison, const std::map<std::string, double>& limits) {
    int code = static_cast<int>(ExitCode::done);
    for (const auto& [name, limit] : limits) {
        const std::optional<double> value = metric_named(comparison, name);
        if (value && *value <= limit) continue;  // written so that a NaN does not pass
        const std::string shown = value ? fmt::format("is {:.6g}, ", *value) : "cannot be computed, ";
        print_message("{} {}over --max-{} {}\n", name, shown, name, limit);
        code = static_cast<int>(ExitCode::over_threshold);
    }
    return code;
}

}  // namespace

nlohmann::ordered_json metrics_json(const ImageComparison& comparison) {
    const Metrics& m = comparison.metrics;
    return {{"rmse", m.rmse},
            {"mae", m.mae},
            {"relmse", m.relmse},
            {"smape", m.smape},
            {"flip", or_null(comparison.flip_mean)},
            {"psnr", or_null(m.psnr)},
            {"mean_ref", m.mean_ref},
            {"mean_test", m.mean_test},
            {"max_abs", m.max_abs}};
}

void add_compare_flags(Flags& flags, CompareOptions& options) {
    flags.add("REF", "", options.ref, "reference image").required();
    flags.add("TEST", "", options.test, "image to compare with it").required();
    add_json_flag(flags, options.json, "the metrics");
    flags.add("--mask", "FILE", options.mask,
              "image of the same size; pixels that are black in it are left out");
    flags.add_parsed("--box", "X0,Y0,X1,Y1", options.box, parse_pixel_box,
                     "compare columns X0 to X1-1 and rows Y0 to Y1-1 only");
    flags.add("--diff", "FILE", options.diff, "write a picture of the difference, .exr or .png");
    flags.add_switch("--strict", options.strict, "refuse images of different crop windows");
    for (const std::string key : {"rmse", "relmse", "flip", "mae", "abs"}) {
        const auto take = [&options, key](double limit) {
            if (!(limit >= 0.0))
                throw Error(ExitCode::usage, fmt::format("--max-{}: {} is not 0 or above", key, limit));
            options.max[key] = limit;
        };
        flags.on<double>("--max-" + key, "E", take,
                         fmt::format("exit with code 5 when {} is over this",
                                     key == "abs" ? "the largest difference" : key));
    }
}

int run_compare(const CompareOptions& options) {
    check_outputs({options.diff, options.json}, {options.ref, options.test, options.mask});
    const ImageComparison comparison = compare(options);
    if (const auto& box = comparison.common) {
        const std::string words =
            fmt::format("an image lacks pixels: compared in the window {},{},{},{} of both", box->x0, box->y0,
                        box->x1, box->y1);
        if (options.strict) throw Error(ExitCode::input_refused, words + " (--strict)");
        print_message("voxilux: note: {}\n", words);
    }
    if (options.json != "-") print_facts(comparison);
    write_json(options.json, metrics_json(comparison));
    if (comparison.metrics.non_finite > 0) {
        print_message("{} of {} pixels hold a NaN or an infinity: no metric is defined\n",
                      comparison.metrics.non_finite, comparison.metrics.pixels);
    }
    if (!options.diff.empty())
        write_image(options.diff,
                    difference_image(comparison, std::filesystem::path(options.diff).extension() == ".png"));
    return check_limits(comparison, options.max);
}

}  // namespace voxilux
