#include "view/render_command.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/error.h"

namespace voxilux {
namespace {

// Flags that only a window has, and flags that the line writes anew. All of them take a value.
constexpr std::array<std::string_view, 20> kDropped{
    "--script",           "--frames",     "--screenshot", "--report",     "--frame-time", "--error",
    "--time-limit",       "--size",       "--spp",        "--iterations", "--camera",     "--projection",
    "--pixels-per-voxel", "--background", "--frame",      "--turntable",  "--turn",       "--state",
    "--quality",          "--ao-rays"};
constexpr std::string_view kTransparent = "--transparent";  // which --background undoes

// A word quoted for a shell.
std::string quoted(const std::string& word) {
    const auto is_plain = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
               std::string_view("-_=./,:%+").find(c) != std::string_view::npos;
    };
    if (!word.empty() && std::ranges::all_of(word, is_plain)) return word;
    std::string text = "'";
    for (const char c : word)
        text += c == '\'' ? "'\\''" : std::string(1, c);
    return text + "'";
}

void check(const ViewState& state) {
    if (state.view.camera.fov_y_deg >= 180.0)
        throw Error(ExitCode::usage, "no line: --viewpoint knows fields of view below 180 degrees only");
    if (state.picture.is_moving() || state.picture.samples() == 0)
        throw Error(ExitCode::usage, "no line: the picture is not at rest");
}

// Effects that were switched in the window.
void add_switches(const ViewState& state, std::vector<std::string>& line) {
    for (const auto& [effect, choice] : state.picture.request().effects.switches)
        if (choice != Switch::automatic)
            line.push_back(
                fmt::format("--effect {}={}", name_of(effect), choice == Switch::on ? "on" : "off"));
}

void add_camera(const Camera& camera, std::vector<std::string>& line) {
    line.push_back(fmt::format("--viewpoint {},{},{},{},{},{}", camera.position.x, camera.position.y,
                               camera.position.z, camera.yaw_deg, camera.pitch_deg, camera.fov_y_deg));
    if (camera.projection == Projection::orthographic)
        line.push_back(fmt::format("--pixels-per-voxel {}", camera.pixels_per_voxel));
    else if (camera.projection != Projection::perspective)
        line.push_back(
            fmt::format("--projection {}", kProjectionNames[static_cast<std::size_t>(camera.projection)]));
}

// The frame, and what a window shows differently from the file.
void add_frame(const ViewState& state, std::vector<std::string>& line) {
    if (state.frames) line.push_back(fmt::format("--frame {}", state.frame));
    const Sun& sun = state.picture.renderer().scene().sun;
    if (state.turns_sun || state.has_moved_sun)  // --viewpoint stops the turntable
        line.push_back(fmt::format("-D sun.azimuth={}", sun.azimuth_deg));
    if (state.has_moved_sun) line.push_back(fmt::format("-D sun.elevation={}", sun.elevation_deg));
    if (state.had_shadow_only) line.emplace_back("-D ground.shadow_only=false");
    line.emplace_back("--background sky");
}

}  // namespace

std::string render_command(const std::vector<std::string>& words, const std::string& input,
                           const ViewState& state) {
    check(state);
    std::vector<std::string> line{"voxilux", "render", quoted(state.input.string())};
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] == input || words[i] == kTransparent) continue;
        const std::string_view name = std::string_view(words[i]).substr(0, words[i].find('='));
        if (std::ranges::find(kDropped, name) == kDropped.end())
            line.push_back(quoted(words[i]));
        else if (name == words[i])
            ++i;  // its value is the next word
    }
    add_switches(state, line);
    const glm::ivec2 size = state.picture.settings().size;
    line.push_back(fmt::format("--size {}x{} --spp {} --ao-rays {}", size.x, size.y, state.picture.samples(),
                               state.picture.settings().ao_rays));
    add_camera(state.view.camera, line);
    add_frame(state, line);
    line.push_back("-o " + quoted(state.input.stem().string() + ".exr"));
    return fmt::format("{}", fmt::join(line, " "));
}

}  // namespace voxilux
