#pragma once

// Windows of a virtual display, driven by scripts: the same code as a person's input.

#include <gtest/gtest.h>

#include <string_view>

#include "formats/image_file.h"
#include "tools/cli/words.h"

namespace voxilux::test {

#define SKIP_UNLESS_DISPLAY() \
    if (std::string_view(VX_BINARY).empty()) GTEST_SKIP() << "no xvfb-run (Debian: apt install xvfb)"

// The colours of an image.
inline std::map<std::string, std::vector<float>> beauty_of(const std::filesystem::path& file) {
    const Image image = read_image(file);
    std::map<std::string, std::vector<float>> planes;
    for (const char* name : {"R", "G", "B"})
        planes[name] = image.channels.at(name).pixels;
    return planes;
}

// What a script leaves in a folder; its report is report.json.
inline Ending play(const ScratchFolder& scratch, const std::string& script, const Words& more = {}) {
    write_text(scratch / "script.toml", script);
    const Ending ending = run(with({"view", scene_file("first_light"), "--size", "160x90", "--spp", "3",
                                    "--script", "script.toml", "--report", "report.json", "--validation"},
                                   more),
                              {.folder = scratch.path()});
    EXPECT_EQ(ending.code, 0) << ending.err;
    return ending;
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
