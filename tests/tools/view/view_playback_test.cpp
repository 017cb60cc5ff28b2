// Frames of an animation in the window, against renders of the frames.

#include "tools/view/view_hut.h"

namespace voxilux::test {
namespace {

const std::string kTurntable = scene_file("turntable");

TEST(WindowAnimation, frame_is_that_of_render) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    play_scene(scratch, kTurntable,
               film(0, "first.exr") + key("Period") + key("Period") + key("Period") + film(8, "fourth.exr") +
                   key("Comma") + film(16, "third.exr") + key("Space") + pause(40) + key("Space") +
                   film(50, "played.exr"));
    const std::string played = std::to_string(report_of(scratch)["shown"]["frame"].get<int>());
    EXPECT_NE(played, "3") << "it plays";
    for (const auto& [frame, file] : {std::pair<std::string, const char*>{"1", "first.exr"},
                                      {"4", "fourth.exr"},
                                      {"3", "third.exr"},
                                      {played, "played.exr"}})
        EXPECT_EQ(film_of(scratch / file), render_of(scratch, kTurntable, {"--frame", frame})) << frame;
    EXPECT_NE(film_of(scratch / "first.exr"), film_of(scratch / "fourth.exr"));
    EXPECT_EQ(report_of(scratch)["messages"], Json::array());
}

TEST(WindowAnimationNightly, path_of_parallel_rays_is_followed) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    const std::string key_at = "[[camera.key]]\nyaw = 90\npitch = -30\nframe = ";
    write_text(scratch / "path.toml",
               "[render]\nsize = [160, 90]\n[material.a]\ncolor = '#cc8844'\n[[shape]]\nshape = 'box'\n"
               "from = [0, 0, 0]\nto = [5, 4, 3]\nmaterial = 'a'\n"
               "[camera]\nprojection = 'orthographic'\npixels_per_voxel = 9\n" +
                   key_at + "1\nposition = [2, -20, 12]\n" + key_at + "5\nposition = [4, -20, 12]\n");
    play_scene(scratch, "path.toml",
               film(0, "first.exr") + key("Period") + key("Period") + film(8, "third.exr"));
    EXPECT_EQ(film_of(scratch / "first.exr"), render_of(scratch, "path.toml", {"--frame", "1"}));
    EXPECT_EQ(film_of(scratch / "third.exr"), render_of(scratch, "path.toml", {"--frame", "3"}));
    EXPECT_NE(film_of(scratch / "third.exr"), film_of(scratch / "first.exr"));
}

TEST(WindowAnimationNightly, first_frame_is_the_one_that_is_asked_for) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    write_file_atomically(scratch.path() / "hut.vox", shrinking_hut());
    for (const auto& [scene, frame] :
         {std::pair<std::string, const char*>{kTurntable, "10"}, {"hut.vox", "1"}}) {
        play_scene(scratch, scene, film(0, "film.exr"), {"--frame", frame});
        EXPECT_EQ(film_of(scratch / "film.exr"), render_of(scratch, scene, {"--frame", frame})) << scene;
        EXPECT_NE(film_of(scratch / "film.exr"), render_of(scratch, scene)) << scene;
    }
}

TEST(WindowAnimationNightly, light_turns) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    for (const char* const turned : {"light", "model"}) {
        const Words turn{"-D", std::string("camera.turntable.turn=") + turned};
        play_scene(scratch, kTurntable,
                   film(0, "first.exr") + key("Period") + key("Period") + film(8, "third.exr"), turn);
        EXPECT_NE(film_of(scratch / "first.exr"), film_of(scratch / "third.exr"));
        EXPECT_EQ(film_of(scratch / "third.exr"),
                  render_of(scratch, kTurntable, with(turn, {"--frame", "3"})))
            << turned;
    }
}

TEST(WindowAnimationNightly, camera_stays_where_no_key_moves_it) {
    SKIP_UNLESS_DISPLAY();
    const ScratchFolder scratch;
    write_file_atomically(scratch.path() / "hut.vox", shrinking_hut());
    const auto camera_after = [&](const std::string& scene, const std::string& script) {
        const Words turn{"-D", "camera.turntable.turn=light"};
        play_scene(scratch, scene, script + film(20, "film.exr"), scene == kTurntable ? turn : Words{});
        return report_of(scratch)["shown"]["camera"];
    };
    for (const std::string& scene : {kTurntable, std::string("hut.vox")}) {
        const Json turned = camera_after(scene, orbit(2, 25));
        EXPECT_EQ(camera_after(scene, orbit(2, 25) + key("Period") + key("Period") + key("Period")), turned);
        EXPECT_NE(camera_after(scene, ""), turned) << "the orbit turns it";
    }
}

}  // namespace
}  // namespace voxilux::test
