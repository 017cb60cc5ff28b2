#include "command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <functional>
#include <memory>

#include "base/error.h"
#include "base/nearest_name.h"
#include "base/print.h"
#include "bench/bench.h"
#include "compare/compare.h"
#include "convert/convert.h"
#include "denoise/denoise.h"
#include "devices/devices.h"
#include "farm/farm.h"
#include "info/info.h"
#include "manual/manual.h"
#include "merge/merge.h"
#include "plan/plan.h"
#include "render/render.h"
#include "tradeoff/tradeoff.h"
#include "version.h"
#include "view/view.h"
#include "voxelize/voxelize.h"

namespace voxilux {
namespace {

constexpr const char* kExitCodes =
    "    0  done\n"
    "    2  usage: a flag or its value\n"
    "    3  an input was refused\n"
    "    4  stopped by --time-limit before --error was reached; the picture is written\n"
    "    5  compare: over a --max- threshold\n"
    "   69  no usable Vulkan device; farm: no Dask\n"
    "   70  internal error\n"
    "   71  the device was lost\n"
    "   73  an output cannot be written\n"
    "   74  out of memory, or over --memory-budget\n"
    "   75  a temporary failure: try again\n"
    "  130  interrupted; what was rendered is written\n";

constexpr int kHelpColumn = 30;

int usage_error(const std::string& message, const std::string& command) {
    print_message("voxilux: {}\nsee {} --help\n", message, command);
    return static_cast<int>(ExitCode::usage);
}

std::vector<std::string> flags_of(const CLI::App& app) {
    std::vector<std::string> flags;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames())
            flags.push_back("--" + name);
        for (const std::string& name : option->get_snames())
            flags.push_back("-" + name);
    }
    return flags;
}

std::vector<std::string> names_of_subcommands(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({}))
        names.push_back(command->get_name());
    return names;
}

std::string hint(std::string_view typed, const std::vector<std::string>& names) {
    const std::vector<std::string_view> views(names.begin(), names.end());
    const std::optional<std::string_view> nearest = nearest_name(typed, views);
    return nearest ? fmt::format("; did you mean '{}'?", *nearest) : "";
}

// An argument too many, or an unknown flag with the one that was probably meant.
std::string unexpected_words(const CLI::App& app, const CLI::App& command) {
    const std::vector<std::string> words = app.remaining(true);
    const auto flag =
        std::ranges::find_if(words, [](const std::string& word) { return word.starts_with("-"); });
    if (flag == words.end())
        return fmt::format("'{}' is one argument too many", words.empty() ? "" : words.front());
    const std::string name = flag->substr(0, flag->find('='));
    return fmt::format("there is no flag {}{}", name, hint(name, flags_of(command)));
}

// For a subcommand such as bench, whose next word names none of its own subcommands.
std::string missing_part(const CLI::App& command, const std::vector<std::string>& words) {
    const std::vector<std::string> names = names_of_subcommands(command);
    if (words.empty() || words.front().starts_with("-"))
        return fmt::format("{} what? known: {}", command.get_name(), fmt::join(names, ", "));
    const std::vector<std::string_view> views(names.begin(), names.end());
    return fmt::format("there is no {} '{}'{}", command.get_name(), words.front(),
                       name_hint(words.front(), views));
}

int end_of_parse(const CLI::App& app, const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // --help, --version
        app.exit(error);
        return 0;
    }
    const CLI::App* command = &app;
    std::string name = app.get_name();
    while (!command->get_subcommands().empty()) {
        command = command->get_subcommands().front();
        name += " " + command->get_name();
    }
    if (command != &app && !command->get_subcommands({}).empty())
        return usage_error(missing_part(*command, app.remaining(true)), name);
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr)
        return usage_error(unexpected_words(app, *command), name);
    return usage_error(error.what(), name);
}

// What parsing an app needs whatever its flags are.
void prepare_app(CLI::App& app) {
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

// Ends where the first word is missing or names no subcommand; returns nothing where the rest can be parsed.
std::optional<int> check_subcommand(const CLI::App& app, int argc, const char* const* argv) {
    if (argc < 2) {
        print_message("{}", app.help());
        return static_cast<int>(ExitCode::usage);
    }
    const std::string word = argv[1];
    const std::vector<std::string> names = names_of_subcommands(app);
    if (word.starts_with("-") || std::ranges::find(names, word) != names.end()) return {};
    return usage_error(fmt::format("there is no subcommand '{}'{}", word, hint(word, names)), app.get_name());
}

// --alpha with a number is the exponent of the photons' radius; without one it asks for transparency.
std::vector<const char*> with_transparent(int argc, const char* const* argv) {
    std::vector<const char*> words(argv, argv + argc);
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (std::string_view(words[i]) != "--alpha") continue;
        const char* const next = i + 1 < words.size() ? words[i + 1] : "";
        char* end = nullptr;
        (void)std::strtod(next, &end);
        if (end == next || *end != '\0') words[i] = "--transparent";
    }
    return words;
}

// The subcommands, and what each runs with the options that parsing has filled.
class Commands {
  public:
    // `words` follow the subcommand.
    explicit Commands(std::vector<std::string> words) : words_(std::move(words)) {}

    template <class Options>
    void add(CLI::App& app, const std::string& name, const std::string& help,
             void (*add_flags)(Flags&, Options&), int (*run_command)(const Options&)) {
        CLI::App* const command = app.add_subcommand(name, help);
        const auto options = std::make_shared<Options>();
        Flags flags(*command);
        add_flags(flags, *options);
        if constexpr (requires { options->words; }) options->words = words_;
        rows_.push_back({command, [=] { return run_command(*options); }});
    }

    void add(const CLI::App& command, std::function<int()> run_command) {
        rows_.push_back({&command, std::move(run_command)});
    }

    [[nodiscard]] int run() const {
        const auto parsed = std::ranges::find_if(rows_, [](const Row& row) { return row.app->parsed(); });
        VX_ASSERT(parsed != rows_.end());
        return parsed->run();
    }

  private:
    struct Row {
        const CLI::App* app;
        std::function<int()> run;
    };
    std::vector<Row> rows_;
    std::vector<std::string> words_;
};

void add_required_render_flags(Flags& flags, RenderCommand& command) {
    add_render_flags(flags, command).required();
}

void add_bench(CLI::App& app, Commands& commands) {
    CLI::App& bench = *app.add_subcommand("bench", "throughput of one part: march, ao, photons");
    bench.require_subcommand(1);
    commands.add<BenchMarchCommand>(
        bench, "march",
        "rays through each structure of a world, in millions per second of CPU and of wall time",
        add_bench_march_flags, run_bench_march);
    commands.add<BenchAoCommand>(
        bench, "ao", "variants of ambient occlusion: time of each pass, atomics, and error against many rays",
        add_bench_ao_flags, run_bench_ao);
    commands.add<BenchPhotonsCommand>(
        bench, "photons",
        "variants of photon mapping: time of each pass, growth with the job, and error against a picture",
        add_bench_photons_flags, run_bench_photons);
}

// For the build: what is installed beside the program, made from the flags that there are.
void add_generate(CLI::App& app, Commands& commands) {
    CLI::App& generate = *app.add_subcommand("generate", "print the manual page or a completion")->group("");
    generate.require_subcommand(1);
    const auto add = [&](const char* name, std::function<std::string(const ManualCommand&)> text) {
        commands.add(*generate.add_subcommand(name), [&app, text] {
            print_result("{}", text(command_tree(app)));
            return 0;
        });
    };
    add("man", [](const ManualCommand& root) { return man_page(root, kExitCodes); });
    add("bash", bash_completion);
    add("zsh", zsh_completion);
    add("fish", fish_completion);
}

}  // namespace

int run_command_line(int argc, const char* const* argv) {
    CLI::App app{"voxilux renders voxel scenes with Vulkan compute, with or without a GPU.", "voxilux"};
    app.set_version_flag("--version", version_text,
                         "print the version, the build and its libraries and exit");
    app.set_help_flag("-h,--help", "print this help and exit");
    app.get_formatter()->column_width(kHelpColumn);
    app.require_subcommand(1);
    prepare_app(app);

    const std::vector<const char*> given = with_transparent(argc, argv);
    Commands commands({given.begin() + std::min(argc, 2), given.end()});
    commands.add<RenderCommand>(app, "render", "render a scene to EXR and PNG", add_required_render_flags,
                                run_render);
    commands.add<PlanCommand>(app, "plan",
                              "what render would do with the same flags, what it would leave out, and why",
                              add_plan_flags, run_plan);
    commands.add<TradeoffCommand>(app, "tradeoff",
                                  "the price list: error against time for each setting that approximates",
                                  add_tradeoff_flags, run_tradeoff);
    commands.add<ViewCommand>(app, "view", "show a scene in a window while it is rendered", add_view_flags,
                              run_view);
    commands.add<InfoOptions>(app, "info",
                              "what is in a .vox, .toml, .exr or .png file, other voxels or a mesh",
                              add_info_flags, run_info);
    commands.add<DevicesCommand>(app, "devices", "Vulkan devices, which would be used, what each lacks",
                                 add_devices_flags, run_devices);
    commands.add<CompareOptions>(app, "compare", "metrics between two images (EXR or PNG) in linear light",
                                 add_compare_flags, run_compare);
    commands.add<MergeCommand>(app, "merge",
                               "join parts of one render that render --samples or --shard wrote",
                               add_merge_flags, run_merge);
    commands.add<DenoiseCommand>(app, "denoise",
                                 "filter the noise of what render --denoise on --samples wrote",
                                 add_denoise_flags, run_denoise);
    commands.add<FarmCommand>(app, "farm", "one picture or a film on many machines, by Dask", add_farm_flags,
                              run_farm);
    commands.add<VoxelizeCommand>(app, "voxelize", "turn a mesh (glTF, OBJ, STL, PLY) into a .vox file",
                                  add_voxelize_flags, run_voxelize);
    commands.add<ConvertCommand>(app, "convert",
                                 "turn voxels or a mesh into a .vox file, or voxels into a .glb mesh",
                                 add_convert_flags, run_convert);
    add_bench(app, commands);
    add_generate(app, commands);
    app.footer(fmt::format("voxilux SUBCOMMAND --help lists its flags.\n\nExit codes:\n{}", kExitCodes));

    if (const auto code = check_subcommand(app, argc, argv)) return *code;
    try {
        app.parse(argc, given.data());
    } catch (const CLI::ParseError& error) {
        return end_of_parse(app, error);
    }
    return commands.run();
}

void parse_words(std::vector<std::string> words, const std::function<void(Flags&)>& add_flags) {
    CLI::App app;
    app.set_help_flag();
    prepare_app(app);
    Flags flags(app);
    add_flags(flags);
    std::ranges::reverse(words);  // as CLI11 takes them
    try {
        app.parse(std::move(words));
    } catch (const CLI::ParseError& error) {
        const bool is_unknown = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
        throw Error(ExitCode::usage, is_unknown ? unexpected_words(app, app) : error.what());
    }
}

}  // namespace voxilux
