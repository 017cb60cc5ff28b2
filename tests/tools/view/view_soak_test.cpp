// A long session in the window.

#include <algorithm>

#include "tools/view/view_hut.h"

namespace voxilux::test {
namespace {

constexpr int kFrames = 10000;
// Memory of the last tenth over that of the second, when all pipelines are made. It was the same to 0.1 MiB
// of 290 over 4000 frames; the rest of the 2 % is for pipelines that a rare order of acts makes late.
constexpr double kMaxGrowth = 1.02;
// A leak that must be noticed, MiB in a thousand frames: a tenth of a film in each of twelve resizes.
constexpr double kLeak_mib = 1.0;

using ResidentMib = std::vector<double>;  // by frame

double growth_of(const ResidentMib& resident) {
    const auto median = [&](std::size_t tenth) {
        const auto at = [&](std::size_t i) {
            return resident.begin() + static_cast<std::ptrdiff_t>(i * resident.size() / 10);
        };
        ResidentMib mib(at(tenth), at(tenth + 1));
        std::ranges::sort(mib);
        return mib[mib.size() / 2];
    };
    return median(9) / median(1);
}

// What happens in every twelfth frame; the numbers select different actions.
std::string act(int number) {
    const auto text = [](int i) { return std::to_string(i); };
    switch (number % 8) {
        case 0:
            return "[[step]]\nmove = [80, 45]\n[[step]]\npress = 'left'\n[[step]]\nmove = [" +
                   text(60 + number % 50) + ", 40]\n[[step]]\nrelease = 'left'\n";
        case 1:
            return "[[step]]\nedit = { from = [" + text(number % 9 - 5) + ", -4, 2], to = [" +
                   text(number % 9 - 3) + ", 1, 9], material = " + text(number % 2) + " }\n";
        case 2:
            return "[[step]]\nscroll = " + text(number % 2 == 0 ? 1 : -1) + "\n" + key("5");
        case 3:
            return held_key("Control", "z");
        case 4:
            return "[[step]]\nresize = [" + text(100 + number * 7 % 90) + ", " + text(60 + number * 5 % 50) +
                   "]\n";
        case 5:
            return (number % 16 == 5 ? key("c") : key("g"));
        case 6:
            return number % 16 == 6 ? "[[step]]\ndrop = 'other.vox'\n" : "[[step]]\ndrop = 'hut.vox'\n";
        default:
            return key("Enter") + key("t") + key("7") + key(number % 16 == 7 ? "Left" : "Up") +
                   "[[step]]\nresize = [" + text(100 + number * 11 % 90) + ", " + text(60 + number * 3 % 50) +
                   "]\n";
    }
}

TEST(WindowSoakNightly, ten_thousand_frames_keep_memory_and_messages_flat) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    write_file_atomically(scratch.path() / "other.vox", hut(7));
    std::string script;
    for (int frame = 10; frame < kFrames; frame += 12)
        script += "[[step]]\nframe = " + std::to_string(frame) + "\nmove = [5, 5]\n" + act(frame / 12);
    write_file_atomically(scratch.path() / "hut.vox", hut());
    // By frame `done` the finest preset has all its samples.
    const int done = kFrames + 400;
    script += "[[step]]\nframe = " + std::to_string(kFrames) + "\ndrop = 'hut.vox'\n" + act(1) + act(3) +
              "[[step]]\nframe = " + std::to_string(done) + "\nscreenshot = 'film.exr'\n" +
              held_key("Control", "c") + pause(done + 4);
    write_text(scratch / "script.toml", script);
    ChildProcess child({"view", "hut.vox", "--size", "160x90", "--spp", "8", "--script", "script.toml",
                        "--report", "report.json", "--validation"},
                       {.folder = scratch.path()});
    const Ending ending = child.finish();
    EXPECT_EQ(ending.code, 0) << ending.err;
    const Json report = report_of(scratch);
    EXPECT_EQ(report["messages"], Json::array());
    ASSERT_GE(report["frames"].size(), static_cast<std::size_t>(kFrames));
    ResidentMib resident;
    for (const Json& frame : report["frames"])
        resident.push_back(frame["resident_mib"].get<double>());
    EXPECT_GT(resident[0], 10.0) << "the system says";
    EXPECT_LE(growth_of(resident), kMaxGrowth);
    for (std::size_t i = 0; i < resident.size(); ++i)
        resident[i] += kLeak_mib * static_cast<double>(i) / 1000.0;
    EXPECT_GT(growth_of(resident), kMaxGrowth) << "the negative control: with a leak";
    EXPECT_EQ(film_of(scratch / "film.exr"), film_of_line(scratch, ending, "hut")) << "nothing is left of it";
}

}  // namespace
}  // namespace voxilux::test
