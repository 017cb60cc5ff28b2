#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "manual/manual.h"

namespace voxilux {
namespace {

constexpr const char* kDescription =
    "voxilux renders voxel scenes: MagicaVoxel .vox files, and scene files in TOML with voxels, spheres, sun "
    "and sky. It turns meshes into voxels. It runs on any Vulkan 1.2 device and on Mesa's software device, "
    "which needs no GPU. Every picture comes with an estimate of its error.";

constexpr const char* kEnd =
    ".SH ENVIRONMENT\n"
    ".TP\n.B XDG_CACHE_HOME\nThe folder\n.I voxilux\nin it holds pipelines and references of\n"
    ".BR tradeoff .\nIt may be removed at any time. Without the variable it is in\n.IR ~/.cache .\n"
    ".TP\n.B XDG_STATE_HOME\n.I voxilux/forecasts.jsonl\nin it remembers forecasts of\n.B \\-\\-error\n"
    "and how they turned out. Without the variable it is in\n.IR ~/.local/state .\n"
    ".TP\n.B VK_DRIVER_FILES\nWhich Vulkan drivers the loader offers.\n"
    ".SH FILES\n"
    ".TP\n.I PREFIX/share/voxilux/scenes\nScenes to start from.\n"
    ".TP\n.I PREFIX/share/doc/voxilux\nGuides, the keys of scene files, and the list of changes.\n"
    ".SH EXAMPLES\n"
    ".nf\nvoxilux render castle.vox \\-o castle.png \\-\\-size 1280x720 \\-\\-error 1%\n"
    "voxilux plan castle.vox\n"
    "voxilux view castle.vox\n"
    "voxilux voxelize model.glb \\-o model.vox \\-\\-resolution 512\n.fi\n";

// Text whose characters mean nothing to troff.
std::string escaped(const std::string& text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        const bool starts_line = i == 0 || text[i - 1] == '\n';
        if (starts_line && (c == '.' || c == '\'')) result += "\\&";
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else
            result += c;
    }
    return result;
}

// A text of several lines, such as a list of presets, keeps its line breaks.
std::string paragraph(const std::string& text) {
    const std::string plain = escaped(text);
    return text.find('\n') == text.npos ? plain + "\n" : ".nf\n" + plain + "\n.fi\n";
}

std::string flag_entry(const ManualFlag& flag) {
    std::vector<std::string> names;
    for (const std::string& name : flag.names)
        names.push_back("\\fB" + escaped(name) + "\\fR");
    const std::string value =
        flag.value.empty() || flag.is_argument() ? "" : " \\fI" + escaped(flag.value) + "\\fR";
    return fmt::format(".TP\n{}{}\n{}", fmt::join(names, ", "), value, paragraph(flag.help));
}

std::string synopsis(const ManualCommand& command) {
    std::string line = fmt::format("\\fB{}\\fR [\\fIflags\\fR]", fmt::join(command.path, " "));
    for (const ManualFlag& flag : command.flags)
        if (flag.is_argument())
            line += fmt::format(" \\fI{}\\fR{}", escaped(flag.names.front()), flag.repeats ? " ..." : "");
    return line + "\n";
}

std::string command_section(const ManualCommand& command) {
    std::string text;
    if (command.parts.empty()) {
        text = fmt::format(".SS {}\n{}.PP\n{}", fmt::join(command.path, " "), synopsis(command),
                           paragraph(command.help));
        std::string group;
        for (const ManualFlag& flag : command.flags) {
            if (flag.group != group) text += fmt::format(".PP\n\\fI{}\\fR\n", escaped(flag.group));
            group = flag.group;
            text += flag_entry(flag);
        }
    }
    for (const ManualCommand& part : command.parts)
        text += command_section(part);
    return text;
}

}  // namespace

std::string man_page(const ManualCommand& root, const std::string& exit_codes) {
    std::string text = ".TH VOXILUX 1 \"\" \"voxilux " VX_VERSION
                       "\" \"User Commands\"\n"
                       ".SH NAME\nvoxilux \\- render voxel scenes with Vulkan compute\n"
                       ".SH SYNOPSIS\n\\fBvoxilux\\fR \\fIsubcommand\\fR [\\fIflags\\fR] ...\n";
    text += ".SH DESCRIPTION\n" + paragraph(kDescription);
    for (const ManualFlag& flag : root.flags)
        text += flag_entry(flag);
    text += ".SH SUBCOMMANDS\n";
    for (const ManualCommand& command : root.parts)
        text += command_section(command);
    return text + ".SH EXIT STATUS\n.nf\n" + escaped(exit_codes) + ".fi\n" + kEnd;
}

}  // namespace voxilux
