#include "tradeoff/tradeoff.h"

#include <filesystem>
#include <system_error>

#include "base/error.h"
#include "base/file.h"
#include "base/print.h"
#include "estimators/difference_estimate.h"
#include "interrupt.h"
#include "jobs/effect_price.h"
#include "jobs/price_list/make_price_list.h"
#include "jobs/price_list/price_list.h"
#include "open_input.h"
#include "parse_values.h"
#include "scene/scene_hash.h"
#include "tradeoff/page_maker.h"
#include "write_json.h"

namespace voxilux {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxRepeats = 100;

void prepare_folder(const TradeoffCommand& command) {
    const fs::path pictures = fs::path(command.output) / "pictures";
    std::error_code failure;
    fs::create_directories(pictures, failure);
    if (failure)
        throw Error(ExitCode::cannot_write,
                    fmt::format("{}: cannot make the folder: {}", pictures.string(), failure.message()));
    check_outputs(
        {fs::path(command.output) / "tradeoff.json", pictures / "reference.png", command.report.json},
        {command.scene.input});
}

RenderOptions render_options(const TradeoffCommand& command) {
    RenderOptions options{.plan = command.scene.request, .device = command.device.request()};
    options.executor.cache_dir = command.device.cache_dir();
    options.interrupted = &interrupted_by_signal();
    return options;
}

void warn(const PriceList& list) {
    for (const Parameter& parameter : list.design.parameters) {
        for (const ParameterSetting& setting : parameter.settings) {
            const MeasuredConfiguration& configuration = list.configurations[setting.configuration];
            if (!configuration.refusal.empty())
                print_message("note: {} {} is left out: {}\n", parameter.label, setting.name,
                              configuration.refusal);
            if (configuration.configuration.traversal && configuration.other_pixels.value_or(0) != 0)
                print_message("warning: traversal {} changes {} pixels\n", setting.name,
                              *configuration.other_pixels);
        }
    }
}

}  // namespace

void add_tradeoff_flags(Flags& flags, TradeoffCommand& command) {
    add_scene_flags(flags, command.scene, PicturesOf::frames).required();
    flags.begin_group("Output");
    flags.add("-o,--output", "DIR", command.output, "folder for tradeoff.json, .csv, .html and pictures");
    flags.add_switch("--no-page", command.no_page, "no tradeoff.html, which needs Python and matplotlib");
    add_report_flags(flags, command.report);
    add_progress_flag(flags, command.progress);
    flags.begin_group("Price list");
    flags.add_parsed("--time-limit", "T", command.time_limit_s, parse_duration,
                     "time for the whole: more of it, more samples and a better reference (default 120s)");
    flags.on<int>(
        "--repeats", "N",
        [&command](int repeats) {
            command.repeats =
                static_cast<std::size_t>(checked_range("--repeats", repeats, kMinTrials, kMaxRepeats));
        },
        "pictures of each run, with random numbers of their own; at least 3 (default 3)");
    add_device_flags(flags, command.device, command.scene.request.memory_budget_bytes,
                     "caches of pipelines and references");
}

int run_tradeoff(const TradeoffCommand& command) {
    const RenderOptions options = render_options(command);
    if (command.scene.frames)
        throw Error(ExitCode::usage, "tradeoff: --frames: a price list is of one picture; --frame names it");
    if (command.output.empty())
        throw Error(ExitCode::usage, "tradeoff: -o DIR is missing: where the price list goes");
    ProgressLine line(command.progress, command.report.quiet);
    const Scene scene = load_scene_with(command.scene, !command.report.quiet);
    const std::int64_t frame = frames_to_render(command.scene, scene).first;
    prepare_folder(command);
    if (!command.report.quiet) print_frame_note(command.scene, scene);
    const fs::path cache = options.executor.cache_dir;
    const PriceList list = make_price_list({.name = command.scene.input,
                                            .scene = scene,
                                            .frame = frame,
                                            .options = options,
                                            .time_limit_s = command.time_limit_s,
                                            .repeats = command.repeats,
                                            .references = cache.empty() ? cache : cache / "references",
                                            .on_progress = line.callback()});
    line.finish();
    if (!command.report.quiet) warn(list);
    const fs::path folder = command.output;
    write_price_list(list, folder);
    write_json(command.report.json, to_json(list));
    if (command.report.prints()) print_result("{}", describe(list));
    if (!command.no_page) make_page(folder / "tradeoff.json", folder / "tradeoff.html");
    if (command.report.prints())
        print_result("wrote     {}\n",
                     (folder / (command.no_page ? "tradeoff.json" : "tradeoff.html")).string());
    if (!options.interrupted->load()) return static_cast<int>(ExitCode::done);
    print_message("interrupted: the price list has what was measured until then\n");
    return static_cast<int>(ExitCode::interrupted);
}

}  // namespace voxilux
