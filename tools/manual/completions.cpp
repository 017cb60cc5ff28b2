// Shell completion of subcommands, flags, the words that a value may be, and file names.

#include <functional>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "manual/manual.h"

namespace voxilux {
namespace {

void for_each_command(const ManualCommand& command, const std::function<void(const ManualCommand&)>& take) {
    take(command);
    for (const ManualCommand& part : command.parts)
        for_each_command(part, take);
}

std::vector<std::string> part_names(const ManualCommand& command) {
    std::vector<std::string> names;
    for (const ManualCommand& part : command.parts)
        names.push_back(part.name());
    return names;
}

// Text inside single quotes; the shells differ in how one of the quotes is written there.
std::string quoted(const std::string& text, const std::string& quote) {
    std::string result;
    for (const char c : text)
        result += c == '\'' ? quote : c == '\n' ? " " : std::string(1, c);
    return "'" + result + "'";
}

std::string first_line(const std::string& help) {
    return help.substr(0, help.find('\n'));
}

// ---- bash ----

// What may follow a flag that takes a value. Flags with the same answer share a line.
std::string bash_values(const ManualCommand& command) {
    std::map<std::string, std::vector<std::string>> names_of;
    for (const ManualFlag& flag : command.flags) {
        if (flag.is_argument() || flag.value.empty()) continue;
        const std::vector<std::string> choices = flag.choices();
        const std::string words = fmt::format("_voxilux_words '{}'; return", fmt::join(choices, " "));
        std::vector<std::string>& names = names_of[flag.is_file()    ? "_voxilux_files; return"
                                                   : choices.empty() ? "return"
                                                                     : words];
        names.insert(names.end(), flag.names.begin(), flag.names.end());
    }
    std::string cases;
    for (const auto& [answer, names] : names_of)
        cases += fmt::format("            {}) {} ;;\n", fmt::join(names, "|"), answer);
    return cases;
}

std::string bash_case(const ManualCommand& command) {
    std::vector<std::string> flags;
    for (const ManualFlag& flag : command.flags)
        if (!flag.is_argument()) flags.insert(flags.end(), flag.names.begin(), flag.names.end());
    const std::string other = command.parts.empty()
                                  ? "_voxilux_files"
                                  : fmt::format("_voxilux_words '{}'", fmt::join(part_names(command), " "));
    return fmt::format(
        "    '{}')\n        case $previous in\n{}        esac\n        case $word in\n"
        "            -*) _voxilux_words '{}' ;;\n            *) {} ;;\n        esac ;;\n",
        fmt::join(command.path, " "), bash_values(command), fmt::join(flags, " "), other);
}

constexpr const char* kBashStart =
    "# Completion of voxilux for bash.\n"
    "_voxilux_words() { mapfile -t COMPREPLY < <(compgen -W \"$1\" -- \"$word\"); }\n"
    "_voxilux_files() {\n"
    "    compopt -o filenames 2> /dev/null\n"
    "    mapfile -t COMPREPLY < <(compgen -f -- \"$word\")\n"
    "}\n"
    "_voxilux() {\n"
    "    local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} command=voxilux at\n"
    "    [[ $word != = ]] || word=\n"
    "    [[ $previous != = ]] || previous=${COMP_WORDS[COMP_CWORD-2]}\n"
    "    for ((at = 1; at < COMP_CWORD; ++at)); do\n"
    "        case \"$command ${COMP_WORDS[at]}\" in\n";

// ---- zsh ----

// Characters that the specifications of _arguments are made of.
std::string zsh_text(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
        result += c;
    }
    return result;
}

std::string zsh_action(const ManualFlag& flag) {
    const std::vector<std::string> choices = flag.choices();
    return flag.is_file() ? "_files" : choices.empty() ? " " : fmt::format("({})", fmt::join(choices, " "));
}

std::string zsh_argument(const ManualFlag& flag) {
    if (flag.is_argument())
        return quoted(fmt::format("{}:{}:{}", flag.repeats ? "*" : "", flag.names.front(), zsh_action(flag)),
                      "'\\''");
    const std::string value =
        flag.value.empty() ? "" : fmt::format(":{}:{}", zsh_text(flag.value), zsh_action(flag));
    const std::string about = quoted(fmt::format("[{}]{}", zsh_text(first_line(flag.help)), value), "'\\''");
    const std::string once = flag.repeats ? "'*'" : fmt::format("'({})'", fmt::join(flag.names, " "));
    if (flag.names.size() == 1) return once + flag.names.front() + about;
    return fmt::format("{}{{{}}}{}", once, fmt::join(flag.names, ","), about);
}

std::string zsh_function(const ManualCommand& command) {
    std::string text =
        fmt::format("_{}() {{\n    local line state\n    _arguments -C", fmt::join(command.path, "_"));
    for (const ManualFlag& flag : command.flags)
        text += " \\\n        " + zsh_argument(flag);
    if (command.parts.empty()) return text + "\n}\n";
    text += " \\\n        '1:subcommand:->subcommand' '*::argument:->argument'\n    case $state in\n";
    text += "    subcommand) local -a subcommands=(";
    for (const ManualCommand& part : command.parts)
        text += "\n        " + quoted(part.name() + ":" + zsh_text(first_line(part.help)), "'\\''");
    text += ")\n        _describe subcommand subcommands ;;\n    argument) case $line[1] in\n";
    for (const ManualCommand& part : command.parts)
        text += fmt::format("        {}) _{} ;;\n", part.name(), fmt::join(part.path, "_"));
    return text + "        esac ;;\n    esac\n}\n";
}

// ---- fish ----

std::string fish_condition(const ManualCommand& command) {
    if (command.path.size() == 1) return "__fish_use_subcommand";
    std::string text;
    for (std::size_t i = 1; i < command.path.size(); ++i)
        text += fmt::format("{}__fish_seen_subcommand_from {}", i > 1 ? "; and " : "", command.path[i]);
    if (!command.parts.empty())
        text += fmt::format("; and not __fish_seen_subcommand_from {}", fmt::join(part_names(command), " "));
    return text;
}

std::string fish_flag(const ManualFlag& flag) {
    std::string text;
    for (const std::string& name : flag.names)
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    if (!flag.value.empty()) text += flag.is_file() ? " -r -F" : " -x";
    const std::vector<std::string> choices = flag.choices();
    if (!choices.empty()) text += fmt::format(" -a '{}'", fmt::join(choices, " "));
    return text + " -d " + quoted(first_line(flag.help), "\\'");
}

}  // namespace

std::string bash_completion(const ManualCommand& root) {
    std::string text = kBashStart;
    for_each_command(root, [&](const ManualCommand& command) {
        if (command.path.size() > 1)
            text += fmt::format("            '{0}') command='{0}' ;;\n", fmt::join(command.path, " "));
    });
    text += "        esac\n    done\n    case $command in\n";
    for_each_command(root, [&](const ManualCommand& command) { text += bash_case(command); });
    return text + "    esac\n}\ncomplete -F _voxilux voxilux\n";
}

std::string zsh_completion(const ManualCommand& root) {
    std::string text = "#compdef voxilux\n# Completion of voxilux for zsh.\n";
    for_each_command(root, [&](const ManualCommand& command) { text += zsh_function(command); });
    return text + "_voxilux \"$@\"\n";
}

std::string fish_completion(const ManualCommand& root) {
    std::string text = "# Completion of voxilux for fish.\n";
    for_each_command(root, [&](const ManualCommand& command) {
        const std::string start = fmt::format("complete -c voxilux -n '{}'", fish_condition(command));
        for (const ManualCommand& part : command.parts)
            text +=
                fmt::format("{} -f -a {} -d {}\n", start, part.name(), quoted(first_line(part.help), "\\'"));
        for (const ManualFlag& flag : command.flags)
            if (!flag.is_argument()) text += start + fish_flag(flag) + "\n";
    });
    return text;
}

}  // namespace voxilux
