#include "info/info.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <span>

#include "base/error.h"
#include "base/file.h"
#include "info/file_facts.h"

namespace voxilux {
namespace {

std::string ending_of(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

FileFacts facts_of(const std::filesystem::path& path) {
    const std::string ending = ending_of(path);
    if (ending == ".vox") return vox_facts(path);
    if (ending == ".toml") return scene_facts(path);
    const bool is_checkpoint = ending == ".part";  // FILE.exr.part
    if (ending == ".exr" || ending == ".png" || is_checkpoint) return image_facts(path);
    throw Error(ExitCode::input_refused,
                fmt::format("{}: info reads .vox, .toml, .exr and .png files", path.string()));
}

}  // namespace

CLI::App* add_info(CLI::App& app, InfoOptions& options) {
    CLI::App* command = app.add_subcommand("info", "what is in a .vox file, a scene file, an EXR or a PNG");
    command->add_option("FILE", options.file, "a .vox, .toml, .exr or .png file")->required()->type_name("");
    command->add_option("--json", options.json, "write the facts as JSON; - is standard output")
        ->type_name("FILE");
    return command;
}

int run_info(const InfoOptions& options) {
    const FileFacts facts = facts_of(options.file);
    const std::string json = facts.json.dump(2, ' ', true) + "\n";
    if (options.json != "-") fmt::print("{}", facts.text);
    if (options.json == "-") fmt::print("{}", json);
    if (!options.json.empty() && options.json != "-")
        write_file_atomically(options.json, std::as_bytes(std::span(json)));
    return static_cast<int>(ExitCode::done);
}

}  // namespace voxilux
