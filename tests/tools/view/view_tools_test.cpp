// Voxels changed in the window, against files that have them.

#include "tools/view/view_hut.h"

namespace voxilux::test {
namespace {

TEST(WindowTools, saved_file_renders_as_the_edited_window) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    play_hut(scratch, key("Tab") + film(0, "before.exr") + key("p") + key("BracketRight") +
                          key("BracketRight") + click(80, 60) + key("b") + click(70, 40) + key("r") +
                          click(95, 50) + film(12, "edited.exr") + "[[step]]\nsave = 'edited.vox'\n");
    EXPECT_EQ(report_of(scratch)["shown"]["edits"], 3);
    EXPECT_NE(beauty_of(scratch / "edited.exr"), beauty_of(scratch / "before.exr"));
    EXPECT_NE(bytes_of(scratch / "edited.vox"), bytes_of(scratch / "hut.vox"));
    const Ending render = run({"render", scratch / "edited.vox", "--size", "160x90", "--spp", "3", "-q", "-o",
                               scratch / "render.exr"});
    ASSERT_EQ(render.code, 0) << render.err;
    EXPECT_EQ(beauty_of(scratch / "render.exr"), beauty_of(scratch / "edited.exr"));
}

TEST(WindowTools, undo_of_all_gives_the_first_picture_and_file) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    std::string undo, redo;
    for (int i = 0; i < 4; ++i) {
        undo += held_key("Control", "z");
        redo += held_key("Control", "y");
    }
    play_hut(scratch,
             key("Tab") + film(0, "before.exr") + key("f") + "[[step]]\nmove = [60, 60]\n" +
                 "[[step]]\npress = 'left'\n[[step]]\nmove = [100, 60]\n[[step]]\nrelease = 'left'\n" +
                 key("r") + click(80, 60) + click(80, 60) + key("i") + click(105, 60) + click(50, 25) +
                 film(12, "edited.exr") + undo + film(24, "undone.exr") + "[[step]]\nsave = 'undone.vox'\n" +
                 redo + film(36, "redone.exr"));
    EXPECT_NE(beauty_of(scratch / "edited.exr"), beauty_of(scratch / "before.exr"));
    EXPECT_EQ(beauty_of(scratch / "undone.exr"), beauty_of(scratch / "before.exr"));
    EXPECT_EQ(beauty_of(scratch / "redone.exr"), beauty_of(scratch / "edited.exr"));
    EXPECT_EQ(bytes_of(scratch / "undone.vox"), bytes_of(scratch / "hut.vox"));
    EXPECT_EQ(report_of(scratch)["shown"]["undo"], 4);
}

TEST(WindowTools, stroke_of_the_brush_is_one_step_to_undo) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    // The upper half of a wall, which has the other colour.
    std::string dabs = "[[step]]\nmove = [36, 24]\n[[step]]\npress = 'left'\n";
    for (int x = 38; x <= 64; x += 2)
        dabs += "[[step]]\nmove = [" + std::to_string(x) + ", 24]\n";
    play_hut(scratch, key("Tab") + film(0, "before.exr") + key("b") + key("BracketRight") + dabs +
                          "[[step]]\nrelease = 'left'\n" + film(12, "painted.exr") +
                          held_key("Control", "z") + film(24, "undone.exr") + held_key("Control", "y") +
                          film(36, "redone.exr"));
    EXPECT_NE(film_of(scratch / "painted.exr"), film_of(scratch / "before.exr"));
    EXPECT_EQ(film_of(scratch / "undone.exr"), film_of(scratch / "before.exr"));
    EXPECT_EQ(film_of(scratch / "redone.exr"), film_of(scratch / "painted.exr"));
    EXPECT_EQ(report_of(scratch)["shown"]["undo"], 1);
    EXPECT_GT(report_of(scratch)["shown"]["edits"], 5) << "several dabs";
}

TEST(WindowTools, file_that_somebody_writes_waits_for_unsaved_edits) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    write_file_atomically(scratch.path() / "hut.vox", hut());
    write_text(scratch / "script.toml",
               key("Tab") + key("r") + click(80, 60) + film(4, "edited.exr") +
                   "[[step]]\nframe = 600\nscreenshot = 'late.png'\n" + film(601, "kept.exr") +
                   held_key("Control", "z") + "[[step]]\nframe = 1200\nscreenshot = 'later.png'\n" +
                   film(1201, "loaded.exr") + held_key("Control", "c") + pause(1210));
    ChildProcess child({"view", "hut.vox", "--size", "160x90", "--spp", "3", "--script", "script.toml",
                        "--report", "report.json"},
                       {.folder = scratch.path()});
    ASSERT_TRUE(wait_for(scratch / "edited.exr"));
    write_file_atomically(scratch.path() / "hut.vox", hut(7));
    const Ending ending = child.finish();
    ASSERT_EQ(ending.code, 0);
    EXPECT_EQ(film_of(scratch / "kept.exr"), film_of(scratch / "edited.exr"));
    EXPECT_NE(film_of(scratch / "loaded.exr"), film_of(scratch / "kept.exr"));
    EXPECT_EQ(film_of(scratch / "loaded.exr"), film_of_line(scratch, ending, "hut"))
        << "once they are taken back";
    EXPECT_EQ(report_of(scratch)["shown"]["newer_file"], false);
}

TEST(WindowTools, thousand_edits_equal_a_rebuild_and_their_undo_the_first_file) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    std::string edits, undo;
    unsigned random = 7;
    const auto any = [&](int low, int high) {
        random = random * 1664525u + 1013904223u;
        return low + static_cast<int>((random >> 16) % static_cast<unsigned>(high - low));
    };
    for (int i = 0; i < 1000; ++i) {
        const int x = any(-10, 8), y = any(-10, 8), z = any(0, 10);
        const auto cell = [](int a, int b, int c) {
            return "[" + std::to_string(a) + ", " + std::to_string(b) + ", " + std::to_string(c) + "]";
        };
        const std::string material = any(0, 2) == 0 ? "" : ", material = " + std::to_string(any(0, 2));
        edits += "[[step]]\nedit = { from = " + cell(x, y, z) +
                 ", to = " + cell(x + any(0, 2), y + any(0, 2), z + any(0, 2)) + material + " }\n";
        undo += held_key("Control", "z");
    }
    play_hut(scratch, film(0, "before.exr") + edits + film(6, "edited.exr") +
                          "[[step]]\nsave = 'edited.vox'\n" + undo + film(20, "undone.exr") +
                          "[[step]]\nsave = 'undone.vox'\n");
    ASSERT_EQ(run({"render", scratch / "edited.vox", "--size", "160x90", "--spp", "3", "-q", "-o",
                   scratch / "render.exr"})
                  .code,
              0);
    EXPECT_EQ(beauty_of(scratch / "render.exr"), beauty_of(scratch / "edited.exr"));
    EXPECT_NE(beauty_of(scratch / "edited.exr"), beauty_of(scratch / "before.exr"));
    EXPECT_EQ(beauty_of(scratch / "undone.exr"), beauty_of(scratch / "before.exr"));
    EXPECT_EQ(bytes_of(scratch / "undone.vox"), bytes_of(scratch / "hut.vox"));
}

TEST(WindowTools, scene_file_cannot_be_saved_as_vox) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    play(scratch, film(0, "before.exr") + "[[step]]\nsave = 'a.vox'\n");
    EXPECT_FALSE(std::filesystem::exists(scratch / "a.vox"));
    EXPECT_NE(report_of(scratch)["shown"]["message"].get<std::string>().find(".vox"), std::string::npos);
}

}  // namespace
}  // namespace voxilux::test
