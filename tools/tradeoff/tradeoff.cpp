#include "tradeoff/tradeoff.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <system_error>

#include "base/error.h"
#include "estimators/difference_estimate.h"
#include "formats/scene_hash.h"
#include "jobs/effect_price.h"
#include "output_files.h"
#include "parse_values.h"
#include "render/progress_line.h"
#include "tradeoff/page_maker.h"
#include "tradeoff/price_files.h"
#include "tradeoff/price_list.h"
#include "tradeoff/price_list_json.h"

namespace voxilux {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* kOutput = "Output";
constexpr const char* kPrice = "Price list";
constexpr int kMostRepeats = 100;

// How the time is shared. The rest is for compiling, reading back, comparing and writing.
constexpr double kReferenceShare = 0.30;
constexpr double kEffectShare = 0.10;
constexpr double kRunShare = 0.30;  // of the runs that are planned; more are made until kRunsEnd
constexpr double kRunsEnd = 0.80;   // since the start
constexpr double kRowsEnd = 0.95;
constexpr double kMostRowShare = 0.02;  // of one picture of equal error
constexpr double kLoadShare = 0.04;     // most that a world of its own may take
// A reference is of use up to so many times the samples of the longest run: its noise is then an eighth.
constexpr double kReferenceSamples = 64.0;
constexpr double kMostEffectSamples = 64.0;
constexpr double kEffectTrials = 5.0;  // times of short pictures scatter

// Time since the start, and what of it is left.
struct Budget {
    Clock::time_point start = Clock::now();
    double limit_s = 0.0;

    [[nodiscard]] double elapsed_s() const {
        return std::chrono::duration<double>(Clock::now() - start).count();
    }
    [[nodiscard]] double left_s(double share) const { return share * limit_s - elapsed_s(); }
};

// Progress of the whole command: stages one after the other, each with its share.
class Stages {
  public:
    Stages(ProgressLine& line, const Budget& budget) : show_(line.callback()), budget_(budget) {}

    void begin(double from, double to) {
        from_ = from;
        to_ = to;
        show(0.0, 0);
    }

    void show(double share, std::uint32_t samples) const {
        if (!show_) return;
        const double done = from_ + share * (to_ - from_);
        const double elapsed = budget_.elapsed_s();
        show_({.done = done,
               .elapsed_s = elapsed,
               .remaining_s = done > 0.0 ? elapsed * (1.0 - done) / done : budget_.limit_s,
               .sample = samples});
    }

  private:
    std::function<void(const Progress&)> show_;
    const Budget& budget_;
    double from_ = 0.0;
    double to_ = 0.0;
};

void prepare_folder(const TradeoffCommand& command) {
    const fs::path pictures = fs::path(command.output) / "pictures";
    std::error_code failure;
    fs::create_directories(pictures, failure);
    if (failure)
        throw Error(ExitCode::cannot_write,
                    fmt::format("{}: cannot make the folder: {}", pictures.string(), failure.message()));
    check_writable(fs::path(command.output) / "tradeoff.json");
    check_writable(pictures / "reference.png");
    check_writable(command.json);
}

RenderOptions render_options(const TradeoffCommand& command) {
    RenderOptions options;
    options.plan = plan_request(command.scene);
    options.device = command.device.request();
    options.executor.cache_dir = command.device.cache_dir();
    options.keeps_film = true;  // the reference is made from sums
    return options;
}

std::vector<EffectPrice> price_all(RenderSession& session, const Workshop& workshop, const Way& base,
                                   double per_sample_s, double budget_s) {
    const double rounds =
        budget_s / (static_cast<double>(kEffectCount) * per_sample_s);  // of one sample each
    const double trials = std::clamp(rounds, double{kFewestTrials}, kEffectTrials);
    const double samples = std::clamp(rounds / trials, 1.0, kMostEffectSamples);
    return price_effects(session, {.frame = workshop.frame,
                                   .settings = base.settings,
                                   .request = base.request,
                                   .samples = static_cast<std::uint32_t>(samples),
                                   .trials = std::max(workshop.repeats, static_cast<std::size_t>(trials))});
}

// One sample, which finds the radius of photons.
Measured first_picture(RenderSession& session, const Scene& scene, const Workshop& workshop) {
    const Way way{.settings = scene.settings, .request = workshop.options.plan};
    return measure_once(session, {.way = way, .frame = workshop.frame, .seed = workshop.seed});
}

// All ways have the radius of photons that the first picture found, so that they differ in one thing.
Way base_way(const Scene& scene, const Workshop& workshop, const RenderPlan& plan) {
    Way base{.settings = scene.settings, .request = workshop.options.plan};
    if (plan.photons.runs()) base.settings.photons.radius = plan.photons.radius;
    return base;
}

fs::path reference_folder(const TradeoffCommand& command) {
    const fs::path folder = command.device.cache_dir();
    return folder.empty() ? folder : folder / "references";
}

ReferenceJob reference_job(const TradeoffCommand& command, const Way& base, std::int64_t frame,
                           double limit_s) {
    const double most = kReferenceSamples * 2.0 * base.settings.spp;
    return {.frame = frame,
            .base = base,
            .cache = reference_folder(command),
            .most_samples = static_cast<std::uint32_t>(std::min(most, 1e9)),
            .budget_s = kReferenceShare * limit_s};
}

// Ways, reference and effects are there: the runs and the rows of pictures.
void measure_runs(Workshop& workshop, const SamplePlan& samples, const Budget& budget, Stages& stages,
                  PriceList& list) {
    stages.begin(0.5, 0.85);
    workshop.left_s = [&] { return budget.left_s(kRunsEnd); };
    list.top = measure_levels(workshop, samples, list.asked, list.ways);
    stages.begin(0.85, 0.99);
    workshop.left_s = [&] { return budget.left_s(kRowsEnd); };
    list.equal_time = equal_time_row(workshop, list.design, list.ways, list.top);
    list.equal_error =
        equal_error_row(workshop, list.design, list.ways, list.top, kMostRowShare * budget.limit_s);
}

PriceList measure_all(const TradeoffCommand& command, const Scene& scene, std::int64_t frame,
                      const Budget& budget, Stages& stages) {
    Workshop workshop{.scene = scene,
                      .options = render_options(command),
                      .frame = frame,
                      .seed = scene.settings.seed,
                      .repeats = static_cast<std::size_t>(command.repeats)};
    workshop.on_progress = [&](double share, std::uint32_t samples) { stages.show(share, samples); };
    workshop.options.started = budget.start;
    RenderSession session(scene, workshop.options);
    const Measured first = first_picture(session, scene, workshop);
    const Way base = base_way(scene, workshop, first.outcome.plan);
    PriceList list{.scene = command.scene.input,
                   .scene_hash = scene_hash(scene),
                   .seed = scene.settings.seed,
                   .device = first.outcome.statistics.device,
                   .repeats = workshop.repeats,
                   .design = design_knobs(first.outcome.plan, base),
                   .asked = scene.settings.spp};
    const double limit_s = budget.limit_s;
    stages.begin(0.0, 0.1);
    list.ways = open_ways(workshop, list.design, session,
                          [&](double load_s) { return load_s < kLoadShare * limit_s; });
    const SamplePlan samples = plan_samples(list.ways, list.asked, workshop.repeats, kRunShare * limit_s);
    stages.begin(0.1, 0.4);
    list.reference = make_reference(session, reference_job(command, base, frame, limit_s));
    workshop.reference = &list.reference.image;
    workshop.noise = list.reference.noise();
    stages.begin(0.4, 0.5);
    list.effects = price_all(session, workshop, base, list.ways.front().per_sample_s, kEffectShare * limit_s);
    measure_runs(workshop, samples, budget, stages, list);
    list.wall_s = budget.elapsed_s();
    return list;
}

void warn(const PriceList& list) {
    for (const Knob& knob : list.design.knobs) {
        for (const KnobSetting& setting : knob.settings) {
            const MeasuredWay& way = list.ways[setting.way];
            if (!way.refusal.empty())
                fmt::print(stderr, "note: {} {} is left out: {}\n", knob.label, setting.name, way.refusal);
            if (way.way.traversal && way.other_pixels.value_or(0) != 0)
                fmt::print(stderr, "warning: traversal {} changes {} pixels\n", setting.name,
                           *way.other_pixels);
        }
    }
}

void add_output_flags(CLI::App& tradeoff, TradeoffCommand& command) {
    tradeoff.add_option("-o,--output", command.output, "folder for tradeoff.json, .csv, .html and pictures")
        ->type_name("DIR")
        ->group(kOutput);
    tradeoff.add_flag("--no-page", command.no_page, "no tradeoff.html, which needs Python and matplotlib")
        ->group(kOutput);
    tradeoff.add_option("--json", command.json, "write tradeoff.json there, too; - is standard output")
        ->type_name("FILE")
        ->group(kOutput);
    tradeoff
        .add_option("--progress", command.progress,
                    "progress on standard error: auto (if a terminal), never or json")
        ->type_name("HOW")
        ->group(kOutput);
    tradeoff.add_flag("-q,--quiet", command.quiet, "print errors only")->group(kOutput);
}

}  // namespace

CLI::App* add_tradeoff(CLI::App& app, TradeoffCommand& command) {
    CLI::App* tradeoff = app.add_subcommand(
        "tradeoff", "the price list: error against time for each setting that approximates");
    add_scene_flags(*tradeoff, command.scene);
    add_output_flags(*tradeoff, command);
    tradeoff
        ->add_option("--time-limit", command.time_limit,
                     "time for the whole: more of it, more samples and a better reference (default 120s)")
        ->type_name("T")
        ->group(kPrice);
    tradeoff
        ->add_option("--repeats", command.repeats,
                     "pictures of each run, with random numbers of their own; at least 3 (default 3)")
        ->type_name("N")
        ->group(kPrice);
    add_device_flags(*tradeoff, command.device, command.scene.memory_budget_mib,
                     "caches of pipelines and references");
    return tradeoff;
}

int run_tradeoff(const TradeoffCommand& command) {
    if (command.repeats < static_cast<int>(kFewestTrials) || command.repeats > kMostRepeats)
        throw Error(ExitCode::usage, fmt::format("--repeats: {} is not from {} to {}", command.repeats,
                                                 kFewestTrials, kMostRepeats));
    if (command.scene.frames)
        throw Error(ExitCode::usage, "tradeoff: --frames: a price list is of one picture; --frame names it");
    if (command.output.empty())
        throw Error(ExitCode::usage, "tradeoff: -o DIR is missing: where the price list goes");
    ProgressLine line(command.progress, command.quiet);
    const Budget budget{.limit_s = parse_duration(command.time_limit)};
    Scene scene = load_scene_with(command.scene);
    const std::int64_t frame = frames_to_render(command.scene, scene).first;
    prepare_folder(command);
    if (!command.quiet) print_frame_note(command.scene, scene);
    Stages stages(line, budget);
    const PriceList list = measure_all(command, scene, frame, budget, stages);
    line.finish();
    if (!command.quiet) warn(list);
    const fs::path folder = command.output;
    write_price_list(list, folder);
    write_json(command.json, to_json(list));
    if (!command.quiet && command.json != "-") fmt::print("{}", describe(list));
    if (!command.no_page) make_page(folder / "tradeoff.json", folder / "tradeoff.html");
    if (!command.quiet && command.json != "-")
        fmt::print("wrote     {}\n",
                   (folder / (command.no_page ? "tradeoff.json" : "tradeoff.html")).string());
    return static_cast<int>(ExitCode::done);
}

}  // namespace voxilux
