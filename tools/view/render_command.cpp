#include "view/render_command.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace voxilux {
namespace {

// Flags with a value that only a window has, or that the line says anew.
constexpr std::array<std::string_view, 14> kDropped{
    "--script",           "--frames",    "--screenshot", "--report",     "--frame-time", "--error",
    "--time-limit",       "--size",      "--spp",        "--iterations", "--camera",     "--projection",
    "--pixels-per-voxel", "--background"};

// A word as a shell reads it back.
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

// The switches of effects that were thrown in the window.
void add_switches(const ViewState& state, std::vector<std::string>& line) {
    for (const auto& [effect, choice] : state.picture.request().effects.switches)
        if (choice != Switch::automatic)
            line.push_back(
                fmt::format("--effect {}={}", name_of(effect), choice == Switch::on ? "on" : "off"));
}

}  // namespace

std::string render_command(const std::vector<std::string>& words, const std::string& input,
                           const ViewState& state) {
    std::vector<std::string> line{"voxilux", "render", quoted(state.input.string())};
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] == input || words[i] == "--transparent") continue;
        const std::string_view name = std::string_view(words[i]).substr(0, words[i].find('='));
        if (std::ranges::find(kDropped, name) == kDropped.end())
            line.push_back(quoted(words[i]));
        else if (name == words[i])
            ++i;  // its value is the next word
    }
    add_switches(state, line);
    const Camera& camera = state.view.camera;
    const glm::ivec2 size = state.picture.settings().size;
    line.push_back(fmt::format("--size {}x{} --spp {}", size.x, size.y, state.picture.samples()));
    line.push_back(fmt::format("--viewpoint {},{},{},{},{},{}", camera.position.x, camera.position.y,
                               camera.position.z, camera.yaw_deg, camera.pitch_deg, camera.fov_y_deg));
    line.emplace_back("--background sky");  // which is what a window shows
    line.push_back("-o " + quoted(state.input.stem().string() + ".exr"));
    return fmt::format("{}", fmt::join(line, " "));
}

}  // namespace voxilux
