#include "bench/photon_flags.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "base/error.h"
#include "base/nearest_name.h"
#include "bench/bench_flags.h"
#include "formats/image_file.h"
#include "formats/scene_toml.h"
#include "output_files.h"
#include "parse_box.h"
#include "parse_values.h"

namespace voxilux {
namespace {

constexpr const char* kDefaultScene = "scenes/cornell.toml";
constexpr int kMostRounds = 1000;
constexpr int kMostIterations = 1 << 20;

void check_range(const char* flag, int value, int most) {
    if (value < 1 || value > most)
        throw Error(ExitCode::usage, fmt::format("{}: {} is not from 1 to {}", flag, value, most));
}

std::vector<std::string> series_named(const std::vector<std::string>& names) {
    if (names.empty()) return photon_series();
    std::vector<std::string> series;
    for (const std::string& name : names) {
        if (name == "none") continue;
        if (std::ranges::find(photon_series(), name) == photon_series().end())
            throw Error(ExitCode::usage, fmt::format("--growth: there is no '{}'; there are {}, none", name,
                                                     fmt::join(photon_series(), ", ")));
        if (std::ranges::find(series, name) == series.end()) series.push_back(name);
    }
    return series;
}

std::optional<PixelBox> box_of(const BenchPhotonsCommand& command) {
    if (command.box.empty()) return {};
    if (command.reference.empty())
        throw Error(ExitCode::usage, "--box: there is nothing to compare with; --reference names a picture");
    const PixelWindow window = parse_window("--box", command.box);
    return PixelBox{window.first.x, window.first.y, window.end.x, window.end.y};
}

Scene job_of(const BenchPhotonsCommand& command, const std::string& input) {
    Scene scene = load_scene(input);
    scene.settings.size = parse_size("--size", command.size);
    scene.settings.spp = static_cast<std::uint32_t>(command.iterations);
    scene.settings.seed = command.seed;
    scene.settings.photons = with_photons(scene.settings.photons, command.photons);
    return scene;
}

}  // namespace

void add_photon_bench_flags(CLI::App& command, BenchPhotonsCommand& photons) {
    command.add_option("INPUT", photons.inputs, "scene files (default scenes/cornell.toml)")
        ->take_all()
        ->type_name("");
    command.add_option("--size", photons.size, "picture size in pixels (default 256x256)")->type_name("WxH");
    add_photon_flags(command, photons.photons);
    command.add_option("--iterations", photons.iterations, "of each render (default 64)")->type_name("N");
    add_word_list(command, "--variant", photons.variants,
                  "gather, no-roulette, classic and scatter (default all)")
        ->type_name("NAME,...");
    add_word_list(command, "--growth", photons.growth,
                  "what grows: photons, size, iterations, or none (default all)")
        ->type_name("NAME,...");
    command.add_option("--rounds", photons.rounds, "runs of which the fastest counts (default 2)")
        ->type_name("N");
    command.add_option("--seed", photons.seed, "seed of every random stream (default 0)")->type_name("N");
    command.add_option("--reference", photons.reference, "picture to measure errors against")
        ->type_name("FILE");
    command.add_option("--box", photons.box, "where to measure the error of the blurred picture")
        ->type_name("X0,Y0,X1,Y1");
    command.add_option("--device", photons.device, "index or part of the name, see voxilux devices")
        ->type_name("NAME");
    command.add_option("--json", photons.json, "write the rows as JSON; - is standard output")
        ->type_name("FILE");
}

PhotonBenchOptions photon_bench_options(const BenchPhotonsCommand& command) {
    check_range("--rounds", command.rounds, kMostRounds);
    check_range("--iterations", command.iterations, kMostIterations);
    (void)parse_size("--size", command.size);
    (void)with_photons({}, command.photons);
    PhotonBenchOptions options{.variants = photon_variants_named(command.variants),
                               .growth = series_named(command.growth),
                               .rounds = command.rounds,
                               .device = command.device,
                               .box = box_of(command)};
    if (!command.reference.empty()) options.reference = read_image(command.reference);
    return options;
}

int run_bench_photons(const BenchPhotonsCommand& command) {
    const PhotonBenchOptions options = photon_bench_options(command);
    check_writable(command.json);
    nlohmann::ordered_json rows_json = nlohmann::ordered_json::array();
    nlohmann::ordered_json growth_json = nlohmann::ordered_json::array();
    std::vector<std::string> inputs = command.inputs;
    if (inputs.empty()) inputs.emplace_back(kDefaultScene);
    for (const std::string& input : inputs) {
        const std::string name = std::filesystem::path(input).filename().string();
        bench_photons(name, job_of(command, input), options, [&](const std::vector<PhotonRow>& rows) {
            for (const PhotonRow& row : rows)
                rows_json.push_back(to_json(row));
            if (rows.front().series != "options") growth_json.push_back(to_json(growth_of(rows)));
            if (command.json == "-") return;
            fmt::print("{}\n", describe(rows));
            std::fflush(stdout);
        });
    }
    write_json(command.json, {{"rows", rows_json}, {"growth", growth_json}});
    return static_cast<int>(ExitCode::done);
}

}  // namespace voxilux
