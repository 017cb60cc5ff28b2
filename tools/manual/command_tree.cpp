#include "manual/command_tree.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <string_view>

namespace voxilux {
namespace {

std::vector<std::string> names_of(const CLI::Option& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames())
        names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
        names.push_back("--" + name);
    if (names.empty()) names.push_back(option.get_name());
    return names;
}

ManualFlag flag_of(const CLI::Option& option) {
    const bool has_value = option.get_items_expected_max() > 0;
    const std::string value = option.get_default_str();
    return {.names = names_of(option),
            .value = has_value ? option.get_type_name() : "",
            .help = option.get_description() + (value.empty() ? "" : " (default " + value + ")"),
            .group = option.get_group(),
            .repeats = option.get_items_expected_max() > 1};
}

ManualCommand command_at(const CLI::App& app, std::vector<std::string> path) {
    path.push_back(app.get_name());
    ManualCommand command{.path = path, .help = app.get_description(), .flags = {}, .parts = {}};
    for (const CLI::Option* option : app.get_options())
        command.flags.push_back(flag_of(*option));
    for (const CLI::App* part : app.get_subcommands({}))
        if (!part->get_group().empty()) command.parts.push_back(command_at(*part, path));
    return command;
}

bool is_word(std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, [](unsigned char c) {
        return std::islower(c) || std::isdigit(c) || c == '-' || c == '_';
    });
}

}  // namespace

std::vector<std::string> ManualFlag::choices() const {
    std::vector<std::string> words;
    for (std::size_t at = 0; at < value.size();) {
        const std::size_t end = std::min(value.find_first_of("|,", at), value.size());
        if (is_word(value.substr(at, end - at))) words.push_back(value.substr(at, end - at));
        at = end + 1;
    }
    return words;
}

bool ManualFlag::is_file() const {
    return is_argument() || value.starts_with("FILE") || value == "DIR";
}

ManualCommand command_tree(const CLI::App& app) {
    return command_at(app, {});
}

}  // namespace voxilux
