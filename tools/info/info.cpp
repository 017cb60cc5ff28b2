#include "info/info.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <span>

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/file.h"
#include "scene/vox_info.h"

namespace voxilux {
namespace {

enum class Kind { vox, unknown };

Kind kind_of(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending == ".vox" ? Kind::vox : Kind::unknown;
}

// What is said about a file, for people and for programs.
struct Facts {
    std::string text;
    nlohmann::json json;
};

Facts vox_facts(const std::filesystem::path& path) {
    const auto info = summarize(load_vox(path));
    if (!info) throw Error(ExitCode::input_refused, fmt::format("{}: {}", path.string(), info.reason()));
    return {describe(info.value()), to_json(info.value())};
}

Facts facts_of(const std::filesystem::path& path) {
    switch (kind_of(path)) {
        case Kind::vox:
            return vox_facts(path);
        case Kind::unknown:
            break;
    }
    throw Error(ExitCode::input_refused, fmt::format("{}: info reads .vox files", path.string()));
}

}  // namespace

CLI::App* add_info(CLI::App& app, InfoOptions& options) {
    CLI::App* command = app.add_subcommand("info", "what is in a .vox file");
    command->add_option("file", options.file, "a .vox file")->required();
    command->add_option("--json", options.json, "write the facts as JSON, - for standard output");
    return command;
}

int run_info(const InfoOptions& options) {
    const Facts facts = facts_of(options.file);
    const std::string json = facts.json.dump(2) + "\n";
    if (options.json != "-") fmt::print("{}", facts.text);
    if (options.json == "-") fmt::print("{}", json);
    if (!options.json.empty() && options.json != "-")
        write_file_atomically(options.json, std::as_bytes(std::span(json)));
    return static_cast<int>(ExitCode::done);
}

}  // namespace voxilux
