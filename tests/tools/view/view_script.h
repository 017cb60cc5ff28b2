#pragma once

// Windows of a virtual display, driven by scripts: the same code as a person's input.

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <string_view>
#include <thread>

#include "formats/image_file.h"
#include "tools/cli/words.h"

namespace voxilux::test {

inline bool is_ci() {
    const char* const ci = std::getenv("CI");
    return ci != nullptr && std::string_view(ci) == "true";
}

// Skips without a display, but fails in CI, where a skip would pass without having tried.
#define SKIP_UNLESS_DISPLAY()                                     \
    if (std::string_view(VX_BINARY).empty()) {                    \
        if (is_ci()) FAIL() << "no xvfb-run, which CI must have"; \
        GTEST_SKIP() << "no xvfb-run (Debian: apt install xvfb)"; \
    }                                                             \
    static_assert(true)

using Planes = std::map<std::string, std::vector<float>>;

inline Planes planes_of(const std::filesystem::path& file, const std::vector<std::string>& names) {
    const Image image = read_image(file);
    Planes planes;
    for (const std::string& name : names)
        planes[name] = image.channels.at(name).pixels;
    return planes;
}
// The colours of an image.
inline Planes beauty_of(const std::filesystem::path& file) {
    return planes_of(file, {"R", "G", "B"});
}
// The same with the errors, which both halves of a film tell.
inline Planes film_of(const std::filesystem::path& file) {
    return planes_of(file, {"R", "G", "B", "error.Y"});
}

// What a script leaves in a folder; its report is report.json.
inline Ending play_scene(const ScratchFolder& scratch, const std::string& scene, const std::string& script,
                         const Words& more = {}) {
    write_text(scratch / "script.toml", script);
    const Ending ending = run(with({"view", scene, "--size", "160x90", "--spp", "3", "--script",
                                    "script.toml", "--report", "report.json", "--validation"},
                                   more),
                              {.folder = scratch.path()});
    EXPECT_EQ(ending.code, 0) << ending.err;
    return ending;
}
inline Ending play(const ScratchFolder& scratch, const std::string& script, const Words& more = {}) {
    return play_scene(scratch, scene_file("first_light"), script, more);
}

// A render of the same size and samples.
inline Planes render_of(const ScratchFolder& scratch, const std::string& scene, const Words& more = {}) {
    const Ending render =
        run(with({"render", scene, "--size", "160x90", "--spp", "3", "-q", "-o", "render.exr"}, more),
            {.folder = scratch.path()});
    EXPECT_EQ(render.code, 0) << render.err;
    return film_of(scratch / "render.exr");
}

// Whether a window writes the file within half a minute.
[[nodiscard]] inline bool wait_for(const std::filesystem::path& file) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!std::filesystem::exists(file)) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return true;
}

// The line that Ctrl C printed.
inline std::string printed_line(const Ending& ending) {
    const std::size_t begin = ending.out.find("voxilux render ");
    return begin == std::string::npos ? "" : ending.out.substr(begin, ending.out.find('\n', begin) - begin);
}

// The film of the printed line, which writes to a file named after the scene.
inline Planes film_of_line(const ScratchFolder& scratch, const Ending& ending, const std::string& stem) {
    const std::string line = printed_line(ending);
    if (line.empty()) ADD_FAILURE() << "no line: " << ending.out;
    const std::string command = "cd " + scratch.path().string() + " && " VX_PLAIN_BINARY +
                                line.substr(std::string_view("voxilux").size()) + " -q";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return film_of(scratch / (stem + ".exr"));
}

inline Json report_of(const ScratchFolder& scratch) {
    return Json::parse(bytes_of(scratch / "report.json"));
}

inline std::string orbit(int frame, int columns) {
    return "[[step]]\nframe = " + std::to_string(frame) + "\nkey = 'Tab'\n" +
           "[[step]]\nframe = " + std::to_string(frame + 2) +
           "\nmove = [80, 45]\n[[step]]\npress = 'left'\n[[step]]\nmove = [" + std::to_string(80 + columns) +
           ", 45]\n[[step]]\nrelease = 'left'\n";
}

inline std::string film(int frame, const std::string& file) {
    return "[[step]]\nframe = " + std::to_string(frame) + "\nsamples = 3\nscreenshot = '" + file + "'\n";
}

// A step that presses a key once.
inline std::string key(const std::string& name) {
    return "[[step]]\nkey = '" + name + "'\n";
}
inline std::string held_key(const std::string& holder, const std::string& name) {
    return "[[step]]\npress = '" + holder + "'\n" + key(name) + "[[step]]\nrelease = '" + holder + "'\n";
}
inline std::string pause(int frame) {
    return "[[step]]\nframe = " + std::to_string(frame) + "\nmove = [3, 3]\n";
}

}  // namespace voxilux::test
