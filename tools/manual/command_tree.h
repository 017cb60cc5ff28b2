#pragma once

// The commands and their flags as plain data, from which manual page and completions are made.

#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace voxilux {

// A flag, or an argument without one, which has a single name without hyphens.
struct ManualFlag {
    std::vector<std::string> names;  // "-o", "--output"
    std::string value;               // what --help calls it: FILE; empty for a switch
    std::string help;
    std::string group;  // the heading of --help
    bool repeats = false;

    [[nodiscard]] bool is_argument() const { return !names.front().starts_with("-"); }
    // Words that the value may be: "filmic" and "plain" of "filmic|plain".
    [[nodiscard]] std::vector<std::string> choices() const;
    [[nodiscard]] bool is_file() const;  // or a folder; arguments are files
};

struct ManualCommand {
    std::vector<std::string> path;  // "voxilux", "bench", "march"
    std::string help;
    std::vector<ManualFlag> flags;
    std::vector<ManualCommand> parts;  // its subcommands

    [[nodiscard]] const std::string& name() const { return path.back(); }
};

// Hidden subcommands are left out.
[[nodiscard]] ManualCommand command_tree(const CLI::App& app);

}  // namespace voxilux
