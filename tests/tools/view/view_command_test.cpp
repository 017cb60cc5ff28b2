// The line that Ctrl C prints, against the film of the window.

#include "tools/view/view_hut.h"

namespace voxilux::test {
namespace {

std::string copy() {
    return held_key("Control", "c");
}

TEST(WindowCommand, copied_line_renders_the_same_film) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    const Ending ending = play(scratch, orbit(2, 25) + film(9, "film.exr") + copy() + pause(11),
                               {"--seed", "5", "--effect", "sky=off", "-D", "sun.elevation=30"});
    EXPECT_EQ(film_of_line(scratch, ending, "first_light"), film_of(scratch / "film.exr"));
}

TEST(WindowCommand, copied_line_has_the_sun_that_was_moved) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    const Ending ending = play(
        scratch,
        film(0, "first.exr") + key("Left") + key("Up") + key("Up") + film(9, "film.exr") + copy() + pause(12),
        {"-D", "sun.elevation=30"});
    EXPECT_EQ(film_of_line(scratch, ending, "first_light"), film_of(scratch / "film.exr"));
    EXPECT_NE(film_of(scratch / "first.exr"), film_of(scratch / "film.exr")) << "the sun shows";
    EXPECT_NE(printed_line(ending).find("sun.elevation=35"), std::string::npos) << printed_line(ending);
}

TEST(WindowCommandNightly, copied_line_has_the_lens) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    const std::string view = orbit(2, 25) + key("5") + "[[step]]\nscroll = 2\n";
    const Ending parallel = play(scratch, view + film(9, "film.exr") + copy() + pause(12));
    EXPECT_EQ(film_of_line(scratch, parallel, "first_light"), film_of(scratch / "film.exr"));
    EXPECT_NE(printed_line(parallel).find("--pixels-per-voxel"), std::string::npos);
    const Ending again = play(scratch, view + key("5") + film(9, "film.exr") + copy() + pause(12));
    EXPECT_EQ(film_of_line(scratch, again, "first_light"), film_of(scratch / "film.exr"));
    EXPECT_EQ(printed_line(again).find("--pixels-per-voxel"), std::string::npos);
    const Ending round =
        play(scratch, orbit(2, 25) + film(9, "film.exr") + copy() + pause(12), {"--projection", "fisheye"});
    EXPECT_EQ(film_of_line(scratch, round, "first_light"), film_of(scratch / "film.exr"));
}

TEST(WindowCommand, parallel_viewpoint_needs_its_scale) {
    SKIP_UNLESS_DISPLAY();
    const Ending ending = run({"render", scene_file("first_light"), "--viewpoint", "0,0,0,0,0,45",
                               "--projection", "orthographic", "-o", "never.png"});
    EXPECT_EQ(ending.code, 2);
    EXPECT_NE(ending.err.find("--pixels-per-voxel"), std::string::npos) << ending.err;
}

TEST(WindowCommand, copied_line_renders_the_frame_of_an_animation) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    write_file_atomically(scratch.path() / "hut.vox", shrinking_hut());
    const Ending ending = play_scene(
        scratch, "hut.vox",
        film(0, "first.exr") + orbit(2, 25) + key("Period") + film(9, "film.exr") + copy() + pause(12),
        {"--frame", "0"});
    EXPECT_NE(film_of(scratch / "first.exr"), film_of(scratch / "film.exr"));
    EXPECT_EQ(film_of_line(scratch, ending, "hut"), film_of(scratch / "film.exr"));
}

TEST(WindowCommand, copied_line_has_the_sun_of_a_frame) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    const Ending ending = play_scene(scratch, scene_file("turntable"),
                                     orbit(2, 25) + key("Period") + film(9, "film.exr") + copy() + pause(12),
                                     {"--frame", "6", "-D", "camera.turntable.turn=light"});
    EXPECT_EQ(film_of_line(scratch, ending, "turntable"), film_of(scratch / "film.exr"));
    const std::string line = printed_line(ending);
    EXPECT_NE(line.find("sun.azimuth="), std::string::npos) << line;
}

TEST(WindowCommandNightly, copied_line_shows_the_sky_where_the_scene_does_not) {
    SKIP_UNLESS_DISPLAY();
    for (const char* const flag : {"--transparent", "--alpha", "--background=#20a0ff"}) {
        const ScratchFolder scratch;
        const Ending ending = play_scene(scratch, scene_file("shadow_catcher"),
                                         film(8, "film.exr") + copy() + pause(12), {flag});
        EXPECT_EQ(film_of_line(scratch, ending, "shadow_catcher"), film_of(scratch / "film.exr")) << flag;
    }
}

TEST(WindowCommand, there_is_no_line_in_motion) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    const Ending ending = play(
        scratch, film(0, "film.exr") + "[[step]]\npress = 'Control'\n" + orbit(2, 25) + key("c") + pause(6));
    EXPECT_EQ(printed_line(ending), "");
    EXPECT_EQ(report_of(scratch)["shown"]["message"], "no line: the picture is not at rest");
}

TEST(WindowCommandNightly, unsaved_edits_are_said_to_be_missing) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    const std::string edit = key("Tab") + key("r") + click(80, 60) + film(8, "edited.exr");
    const Ending unsaved = play_hut(scratch, edit + copy() + pause(12));
    EXPECT_EQ(report_of(scratch)["shown"]["message"], "copied, without the unsaved edits");
    EXPECT_NE(film_of_line(scratch, unsaved, "hut"), film_of(scratch / "edited.exr"));
    const Ending saved = play_hut(scratch, edit + held_key("Control", "s") + copy() + pause(12));
    EXPECT_EQ(report_of(scratch)["shown"]["message"], "copied");
    EXPECT_EQ(film_of_line(scratch, saved, "hut"), film_of(scratch / "edited.exr"));
}

}  // namespace
}  // namespace voxilux::test
