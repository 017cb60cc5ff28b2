#include "bench/bench.h"

#include <cstdio>
#include <filesystem>

#include "base/error.h"
#include "base/file.h"
#include "base/print.h"
#include "formats/image_file.h"
#include "formats/scene_toml.h"
#include "write_json.h"

namespace voxilux {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kPhotonScene = "scenes/cornell.toml";
constexpr std::uint32_t kPhotons = 65536;
constexpr double kPhotonRadius = 2.0;  // voxels

// Adds the rows of a scene to `json`, and prints them as they come unless the JSON goes to standard output.
template <class Row>
void print_rows(const std::vector<Row>& rows, const std::string& file, Json& json) {
    for (const Row& row : rows)
        json.push_back(to_json(row));
    if (file == "-") return;
    print_result("{}\n", describe(rows));
    std::fflush(stdout);
}

std::string name_of_file(const std::string& file) {
    return std::filesystem::path(file).filename().string();
}

Scene photon_scene(const BenchPhotonsCommand& command, const std::string& file) {
    Scene scene = load_scene(file);
    RenderSettings& settings = scene.settings;
    settings.size = command.inputs.size;
    settings.spp = static_cast<std::uint32_t>(command.iterations);
    settings.seed = command.inputs.seed;
    settings.photons.count = kPhotons;
    settings.photons.radius = kPhotonRadius;
    for (const auto& change : command.photons)
        change(settings);
    return scene;
}

}  // namespace

void bench_march_scenes(const BenchMarchCommand& command,
                        const std::function<std::vector<BenchRow>(const BenchScene&)>& measure) {
    const BenchInputs& inputs = command.inputs;
    check_outputs({inputs.json}, inputs.files);
    Json json = Json::array();
    std::vector<int> extents = command.extents;
    if (extents.empty() && inputs.files.empty()) extents = {256, 512};
    for (const int extent : extents)
        print_rows(measure(procedural_scene(extent, inputs.seed)), inputs.json, json);
    for (const std::string& file : inputs.files)
        print_rows(measure(file_scene(file, inputs.size)), inputs.json, json);
    write_json(inputs.json, json);
}

int run_bench_march(const BenchMarchCommand& command) {
    MarchBenchOptions options = command.options;
    options.size = command.inputs.size;
    options.seed = command.inputs.seed;
    Device device = open_device({.selector = command.inputs.device});
    bench_march_scenes(command, [&](const BenchScene& scene) { return bench_march(scene, options, device); });
    return static_cast<int>(ExitCode::done);
}

int run_bench_ao(const BenchAoCommand& command) {
    const BenchInputs& inputs = command.inputs;
    check_outputs({inputs.json}, inputs.files);
    Device device = open_device({.selector = inputs.device});
    Json json = Json::array();
    const auto run = [&](const std::string& name, Scene scene) {
        scene.settings.seed = inputs.seed;
        AoStage stage(std::move(scene), device);
        print_rows(bench_ao(name, stage, command.options), inputs.json, json);
    };
    if (inputs.files.empty())
        run("procedural", ao_procedural_scene(command.extent, inputs.seed, inputs.size));
    for (const std::string& file : inputs.files)
        run(name_of_file(file), ao_file_scene(file, inputs.size));
    write_json(inputs.json, json);
    return static_cast<int>(ExitCode::done);
}

int run_bench_photons(const BenchPhotonsCommand& command) {
    const BenchInputs& inputs = command.inputs;
    PhotonBenchOptions options = command.options;
    options.device = inputs.device;
    if (!command.reference.empty())
        options.reference = read_image(command.reference);
    else if (options.box)
        throw Error(ExitCode::usage, "--box: there is nothing to compare with; --reference names a picture");
    check_outputs({inputs.json}, inputs.files);
    Json json = {{"rows", Json::array()}, {"growth", Json::array()}};
    std::vector<std::string> files = inputs.files;
    if (files.empty()) files.emplace_back(kPhotonScene);
    for (const std::string& file : files) {
        bench_photons(name_of_file(file), photon_scene(command, file), options,
                      [&](const std::vector<PhotonRow>& rows) {
                          if (rows.front().series != "options")
                              json["growth"].push_back(to_json(growth_of(rows)));
                          print_rows(rows, inputs.json, json["rows"]);
                      });
    }
    write_json(inputs.json, json);
    return static_cast<int>(ExitCode::done);
}

}  // namespace voxilux
